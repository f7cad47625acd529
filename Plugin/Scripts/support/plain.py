"""The plugin's filters in a plain Python, without ParaView: a server manager as small as the programs here need.

A proxy is made from its description in Plugin/Proxies: the class, the commands of its properties, their defaults and
enumerations. It answers as ParaView's proxies do, as far as support/pipeline.py asks."""

import os
import sys
import xml.etree.ElementTree

from .command import Failure

_PROXIES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Proxies")
_KINDS = {"IntVectorProperty": int, "IdTypeVectorProperty": int, "DoubleVectorProperty": float,
          "StringVectorProperty": str}
_descriptions = {}


class Property:
    """How a property reaches the object of the proxy."""

    def __init__(self, element):
        self.name = element.get("name")
        self.command = element.get("command")
        self.clean = element.get("clean_command")
        self.repeats = element.get("repeat_command") == "1"
        self.port = int(element.get("port_index", "0"))
        self.is_input = element.tag == "InputProperty"
        self.kind = _KINDS.get(element.tag)
        if self.kind is None and not self.is_input:
            raise Failure(f"{self.name}: properties of kind {element.tag} are known to ParaView only")
        self.texts = {entry.get("text"): int(entry.get("value"))
                      for entry in element.iterfind("EnumerationDomain/Entry")}
        self.default = element.get("default_values")

    def set_default(self, algorithm):
        if self.default is None or self.is_input:
            return
        if self.kind is str:
            values = [self.default] if not self.repeats else []
        else:
            values = [self.kind(part) for part in self.default.split()]
        self._send(algorithm, values)

    def set(self, algorithm, value):
        if self.is_input:
            algorithm.SetInputConnection(self.port, value.SMProxy.GetClientSideObject().GetOutputPort(value.Port))
            return
        values = list(value) if isinstance(value, (list, tuple)) else [value]
        self._send(algorithm, [self._number(part) for part in values])

    def _number(self, value):
        if isinstance(value, str) and self.texts:
            if value not in self.texts:
                raise ValueError(f"{self.name}: '{value}' is none of {', '.join(self.texts)}")
            return self.texts[value]
        return self.kind(value)

    def _send(self, algorithm, values):
        if self.clean:
            getattr(algorithm, self.clean)()
        send = getattr(algorithm, self.command)
        if self.repeats:
            for value in values:
                send(value)
        else:
            send(*values)


class Description:
    """The XML of a proxy."""

    def __init__(self, name):
        root = xml.etree.ElementTree.parse(os.path.join(_PROXIES, f"{name}.xml")).getroot()
        element = next(entry for entry in root.iter() if entry.get("name") == name and entry.get("class"))
        self.class_name = element.get("class")
        self.label = element.get("label")
        known = [entry for entry in element if entry.tag.endswith("Property") and entry.get("command")]
        self.information = {entry.get("name"): entry.get("command") for entry in known
                            if entry.get("information_only") == "1"}
        self.properties = {entry.get("name"): Property(entry) for entry in known
                           if entry.get("information_only") != "1"}


class Port:
    """One output of a proxy."""

    def __init__(self, proxy, index):
        self.proxy, self.Port = proxy, index
        self.SMProxy = proxy.SMProxy

    def UpdatePipeline(self):
        self.proxy.UpdatePipeline()

    def UpdatePipelineInformation(self):
        self.proxy.UpdatePipelineInformation()


class _Handle:
    """What ParaView's proxies answer behind SMProxy."""

    def __init__(self, algorithm, label):
        self._algorithm, self._label = algorithm, label

    def GetClientSideObject(self):
        return self._algorithm

    def GetXMLLabel(self):
        return self._label


class _Text:
    def __init__(self, data):
        self._data = data

    def GetData(self):
        return self._data


class Proxy:
    """A source, filter or writer; its given properties are kept, so that ParaView can be told to make it again."""

    Port = 0

    def __init__(self, name, properties):
        if name not in _descriptions:
            _descriptions[name] = Description(name)
        self.name, self.given = name, properties
        self._description = description = _descriptions[name]
        self._algorithm = getattr(_classes(), description.class_name)()
        self.SMProxy = _Handle(self._algorithm, description.label)
        for known in description.properties.values():
            known.set_default(self._algorithm)
        for key, value in properties.items():
            description.properties[key].set(self._algorithm, value)

    def __getitem__(self, index):
        return Port(self, index)

    def UpdatePipeline(self):
        if self._algorithm.IsA("vtkWriter"):
            self._algorithm.Write()
        else:
            self._algorithm.Update()

    def UpdatePipelineInformation(self):
        self._algorithm.UpdateInformation()

    def UpdatePropertyInformation(self):
        self._algorithm.UpdateInformation()

    def GetProperty(self, name):
        return _Text(getattr(self._algorithm, self._description.information[name])())


def _classes():
    """The package multispectral, from where the launcher says that it is."""
    folder = os.environ["MULTISPECTRAL_PYTHON"]
    if folder not in sys.path:
        sys.path.insert(0, folder)
    import multispectral
    return multispectral


class _Factory:
    """Proxies by name: simple.SampleTableReader(FileName=...), servermanager.writers.SampleTableWriter(...)."""

    def __getattr__(self, name):
        if not os.path.isfile(os.path.join(_PROXIES, f"{name}.xml")):
            raise AttributeError(name)
        return lambda registrationName=None, **properties: Proxy(name, properties)


class _ServerManager:
    writers = _Factory()

    @staticmethod
    def Fetch(source, idx=0):
        algorithm = source.SMProxy.GetClientSideObject()
        algorithm.Update()
        return algorithm.GetOutputDataObject(idx)


simple = _Factory()
servermanager = _ServerManager()


def recipe(*sources):
    """All that the sources need, in order, for ParaView to make it again: [name, {property: value}]; a source in it
    is {"proxy": its place, "port": its output}. Returns the list and the places of the sources."""
    made, places = [], {}

    def place(source):
        proxy = getattr(source, "proxy", source)
        if id(proxy) not in places:
            given = {key: {"proxy": place(value), "port": value.Port} if isinstance(value, (Proxy, Port)) else value
                     for key, value in proxy.given.items()}
            places[id(proxy)] = len(made)
            made.append([proxy.name, given])
        return places[id(proxy)]

    return made, [place(source) for source in sources]
