"""Points and lines drawn over a view, at places of the image that it shows."""

from PyQt5 import QtGui
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor2D, vtkCoordinate, vtkPolyDataMapper2D

_EDGE = "#FFFFFF"


class Marks:
    """The marks of one owner, in any number of views."""

    def __init__(self):
        self._actors = {}  # by view: the renderer and its actors

    def show(self, view, points=(), lines=(), size=7):
        """points: (place, color); lines: (places, color). They take the place of those shown before."""
        actors = self._of(view)
        edge = [(place, _EDGE) for place, _ in points]
        for actor, content, width in zip(actors, ((edge, ()), (points, ()), ((), lines)), (size + 4, size, 2)):
            actor.GetMapper().SetInputData(_data(*content))
            actor.GetProperty().SetPointSize(width)
            actor.GetProperty().SetLineWidth(width)
        view.GetRenderWindow().Render()

    def clear(self, view):
        self.show(view)

    def _of(self, view):
        key, renderer = view.SMProxy.GetGlobalID(), view.GetRenderer()
        if key not in self._actors or self._actors[key][0] is not renderer:
            self._actors[key] = renderer, [_actor(renderer) for _ in range(3)]
        return self._actors[key][1]


def _actor(renderer):
    coordinate = vtkCoordinate()
    coordinate.SetCoordinateSystemToWorld()
    mapper = vtkPolyDataMapper2D()
    mapper.SetTransformCoordinate(coordinate)
    mapper.SetColorModeToDirectScalars()
    mapper.SetInputData(vtkPolyData())
    actor = vtkActor2D()
    actor.SetMapper(mapper)
    renderer.AddActor2D(actor)
    return actor


def _data(points, lines):
    places, colors = vtkPoints(), vtkUnsignedCharArray()
    colors.SetNumberOfComponents(3)
    single, chains = vtkCellArray(), vtkCellArray()
    for place, color in points:
        single.InsertNextCell(1)
        single.InsertCellPoint(places.InsertNextPoint(place[0], place[1], 0.0))
        _add(colors, color)
    for chain, color in lines:
        chains.InsertNextCell(len(chain))
        for place in chain:
            chains.InsertCellPoint(places.InsertNextPoint(place[0], place[1], 0.0))
        _add(colors, color)
    data = vtkPolyData()
    data.SetPoints(places)
    data.SetVerts(single)
    data.SetLines(chains)
    data.GetCellData().SetScalars(colors)
    return data


def _add(colors, name):
    color = QtGui.QColor(name)
    colors.InsertNextTuple3(color.red(), color.green(), color.blue())


def rectangle(a, b):
    """Its outline, from two opposite corners."""
    return [(a[0], a[1]), (b[0], a[1]), (b[0], b[1]), (a[0], b[1]), (a[0], a[1])]
