#!/usr/bin/env python3
"""The structure checks fail where they have to: each rule broken once, in a tree of its own."""

import os
import tempfile
import unittest

import check_documentation
import check_includes
import check_tidy


class Tree(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def write(self, path, text):
        path = os.path.join(self.folder.name, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)


class Includes(Tree):
    def faults(self, path, *includes):
        self.write("Filters/DataModel/SpectralAxis.h", "")
        self.write("Filters/Sampling/vtkPatchSampler.h", "")
        self.write("Filters/Kernels/Spectra/WavelengthGrid.h", "")
        self.write("Readers/Formats/Curves.h", "")
        self.write(path, "".join(f"#include {include}\n" for include in includes))
        return check_includes.check(self.folder.name)[1]

    def test_right_ones_pass(self):
        self.assertEqual(self.faults("Filters/Kernels/Gap/Gap.cpp", '"Kernels/Spectra/WavelengthGrid.h"',
                                     "<Eigen/Core>", "<vector>"), [])
        self.assertEqual(self.faults("Filters/Calibration/vtkFit.cxx", '"SpectralAxis.h"', '"vtkTable.h"',
                                     '"Kernels/Spectra/WavelengthGrid.h"'), [])
        self.assertEqual(self.faults("Readers/vtkReader.cxx", '"Formats/Curves.h"', '"SpectralAxis.h"'), [])
        self.assertEqual(self.faults("Filters/Kernels/Gap/TestGap.cpp", "<gtest/gtest.h>", "<fstream>"), [])
        self.assertEqual(self.faults("Readers/Formats/Images.cpp", "<OpenImageIO/imageio.h>"), [])
        self.assertEqual(self.faults("Plugin/Desktop/Reaction.cxx", "<QAction>", '"pqReaction.h"',
                                     '"vtkPatchSampler.h"'), [])

    def test_wrong_ones_fail_with_place_and_reason(self):
        wrong = (
            ("Filters/Kernels/A.cpp", '"vtkTable.h"', "knows no VTK"),
            ("Filters/Kernels/A.cpp", "<vtkTable.h>", "knows no VTK"),
            ("Filters/Kernels/A.cpp", '"Formats/Curves.h"', "kernels include kernels only"),
            ("Filters/Kernels/A.h", "<fstream>", "no files"),
            ("Filters/Kernels/A.h", "<thread>", "no threads"),
            ("Filters/Kernels/A.cpp", "<gtest/gtest.h>", "only tests"),
            ("Filters/Kernels/A.cpp", "<OpenImageIO/imageio.h>", "image libraries"),
            ("Filters/Kernels/A.cpp", '"Kernels/Missing.h"', "no such file"),
            ("Readers/Formats/A.cpp", '"vtkImageData.h"', "knows no VTK"),
            ("Readers/Formats/A.cpp", '"SpectralAxis.h"', "formats include formats"),
            ("Filters/DataModel/A.cxx", '"vtkPatchSampler.h"', "does not know Filters/Sampling"),
            ("Filters/Calibration/A.cxx", '"vtkPatchSampler.h"', "does not know Filters/Sampling"),
            ("Filters/Calibration/A.cxx", '"Formats/Curves.h"', "no file formats"),
            ("Filters/Calibration/A.cxx", '"vtkPVView.h"', "ParaView"),
            ("Filters/Calibration/A.cxx", "<QString>", "Qt"),
            ("Readers/A.cxx", "<OpenImageIO/imageio.h>", "image libraries"),
            ("Readers/A.cxx", '"Support/vtk/Runs.h"', "only tests"))
        for path, include, reason in wrong:
            with self.subTest(path=path, include=include):
                self.setUp()
                faults = self.faults(path, "<vector>", include)
                self.assertEqual(len(faults), 1, faults)
                self.assertTrue(faults[0].startswith(f"{path}:2: "), faults)
                self.assertIn(reason, faults[0])


PROXY = """<ServerManagerConfiguration><ProxyGroup name="filters">
<SourceProxy name="Mixer" class="vtkMixer" label="Mixer">
<Documentation short_help="x">y</Documentation>
<DoubleVectorProperty name="WhiteLevel" label="White Level"><Documentation>z</Documentation></DoubleVectorProperty>
</SourceProxy></ProxyGroup></ServerManagerConfiguration>"""

PAGE = "# Mixer\n\n## Mathematics\n\n## Inputs\n\n## Outputs\n\n## Properties\n\n| White Level |\n\n## Example\n\n```python\n```\n"


class Pages(Tree):
    def faults(self, page, proxy=PROXY):
        self.write("Plugin/Proxies/Mixer.xml", proxy)
        if page is not None:
            self.write("Documentation/Filters/Mixer.md", page)
        return check_documentation.check(self.folder.name)[1]

    def test_a_whole_page_passes(self):
        self.assertEqual(self.faults(PAGE), [])

    def test_what_is_missing_fails(self):
        self.assertIn("no page", self.faults(None)[0])
        self.assertIn("'## Mathematics'", self.faults(PAGE.replace("## Mathematics", ""))[0])
        self.assertIn("White Level", self.faults(PAGE.replace("White Level", ""))[0])
        self.assertIn("```python", self.faults(PAGE.replace("```python", ""))[0])

    def test_a_page_without_proxy_fails(self):
        self.write("Documentation/Filters/Blender.md", PAGE)
        self.assertIn("Blender", self.faults(PAGE)[0])

    def test_texts_of_the_proxy_itself_are_required(self):
        self.assertIn("WhiteLevel", self.faults(PAGE, PROXY.replace("<Documentation>z</Documentation>", ""))[0])
        self.assertIn("label", self.faults(PAGE, PROXY.replace(' label="White Level"', ' label="white"'))[0])


class Tidy(unittest.TestCase):
    def test_a_source_is_due_after_any_change_of_what_it_is_built_from(self):
        """Also where ccache has written the paths relative to the build."""
        listing = """CMakeFiles/Kernels.dir/unity_0.cxx.o: #deps 3, deps mtime 1 (VALID)
    ../test/Unity/unity_0.cxx
    ../../Filters/Kernels/Gap/Gap.cpp
    /project/Filters/Kernels/Gap/Gap.h
    /usr/include/c++/12/vector

Plugin/moc.cxx.o: #deps 1, deps mtime 1 (VALID)
    Plugin/moc.cxx

"""
        self.assertEqual(check_tidy.headers_of_objects("/project", "/project/build/test", listing),
                         {"CMakeFiles/Kernels.dir/unity_0.cxx.o": ["/project/build/test/Unity/unity_0.cxx",
                                                                   "/project/Filters/Kernels/Gap/Gap.cpp",
                                                                   "/project/Filters/Kernels/Gap/Gap.h"],
                          "Plugin/moc.cxx.o": ["/project/build/test/Plugin/moc.cxx"]})


if __name__ == "__main__":
    unittest.main()
