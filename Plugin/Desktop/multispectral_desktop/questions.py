"""What is to be doubted about samples: the filter Sample Check, whose objects do not stay."""

import re

from paraview import simple

from . import messages

_RESPONSE = re.compile(r"C\d+(\.\d+)?")


def about(samples, name, calibration=None):
    """Sentences; none where the channels have no number. samples: a source, or a function that makes one that goes, too."""
    made = []
    with messages.heard() as said:
        if callable(samples):
            samples = samples()
            made.append(samples)
        samples.UpdatePipeline()
        rows = samples.GetDataInformation(samples.Port).DataInformation.GetRowDataInformation()
        columns = [rows.GetArrayInformation(i).GetName() for i in range(rows.GetNumberOfArrays())]
        if any(map(_RESPONSE.fullmatch, columns)):
            chart = {"Calibration": calibration} if calibration else {}
            made.insert(0, simple.SampleCheck(Input=samples, SamplesName=name, **chart))
            made[0].UpdatePipeline()
    for source in made:
        simple.Delete(source)
    return said.warnings
