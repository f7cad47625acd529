#!/usr/bin/env python3
"""Fails where an #include breaks the direction of the rooms.

    Plugin -> vtk algorithms -> DataModel, Kernels, Formats

usage: check_includes.py ROOT
"""

import os
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
TEST = re.compile(r"(^|/)(Testing/|Test[A-Z]\w*\.(h|cpp|cxx)$|\w+TestData\.h$|\w+Probe\.cpp$)")
SOURCE = (".h", ".cpp", ".cxx")

FILES_AND_THREADS = {
    "cstdio", "filesystem", "fstream", "iostream", "stdio.h",
    "atomic", "condition_variable", "future", "mutex", "shared_mutex", "thread", "pthread.h"}
PARAVIEW = re.compile(r"^(pq|vtkPV|vtkSM(?!P)|vtkSI|vtkProcessModule)")
VTK = re.compile(r"(^|/)vtk\w+\.h$|^Multispectral\w+Module\.h$")

# JSON that goes through the pipeline as text, without any file.
TEXTS = {"Formats/EffectList.h", "Formats/GapReportText.h"}

# Files that a property of a filter names beside its inputs; the data model makes tables of them.
SMALL_FILES = {"Formats/Curves.h"}

# The rooms from the bottom up: the first whose folder holds a file is the file's room.
KERNELS = "Filters/Kernels/"
FORMATS = "Readers/Formats/"
DATA_MODEL = "Filters/DataModel/"
FILTERS = "Filters/"
READERS = "Readers/"
PLUGIN = "Plugin/"
ROOMS = (KERNELS, FORMATS, DATA_MODEL, FILTERS, READERS, PLUGIN)


def room_of(path):
    return next((room for room in ROOMS if path.startswith(room)), None)


def header_index(root):
    """The rooms' own headers by the name that an include without folder uses."""
    index = {}
    for path in sources(root):
        if path.endswith(".h") and room_of(path) not in (KERNELS, FORMATS, None):
            index.setdefault(os.path.basename(path), set()).add(os.path.dirname(path))
    return index


def sources(root):
    for top in ("Filters", "Readers", "Plugin"):
        for folder, names, files in os.walk(os.path.join(root, top)):
            names[:] = [name for name in names if not name.startswith((".", "build"))]
            for name in sorted(files):
                if name.endswith(SOURCE):
                    yield os.path.relpath(os.path.join(folder, name), root)


def fault(path, kind, header, index):
    """Why this file must not include this header, or None."""
    room = room_of(path)
    test = TEST.search(path) is not None
    if not test and ("gtest/" in header or header.startswith("Support/")):
        return "only tests include test support"
    if header.startswith(("OpenImageIO/", "OpenEXR/")) and room != FORMATS:
        return "image libraries are included in Readers/Formats alone"
    if PARAVIEW.match(header) and room != PLUGIN:
        return "ParaView is included in Plugin alone"
    if header.startswith("Q") and kind == "<" and room != PLUGIN:
        return "Qt is included in Plugin alone"
    if room in (KERNELS, FORMATS) and VTK.search(header):
        return f"{room.rstrip('/')} knows no VTK"
    if room == KERNELS:
        if not test and kind == "<" and header in FILES_AND_THREADS:
            return "kernels know no files, no streams to the terminal and no threads"
        if kind == '"' and not test and not header.startswith("Kernels/"):
            return 'kernels include kernels only, as "Kernels/..."'
        return None
    if room == FORMATS:
        if kind == '"' and not test and not header.startswith(("Kernels/", "Formats/")):
            return 'formats include formats and kernels only, as "Formats/..." and "Kernels/..."'
        return None
    if room == DATA_MODEL and header in SMALL_FILES:
        return None
    if header.startswith("Formats/") and room not in (READERS, PLUGIN) and header not in TEXTS:
        return "filters know no file formats"
    return between_algorithms(path, room, header, index)


def between_algorithms(path, room, header, index):
    """Algorithms use the data model and their own folder, not each other."""
    folders = index.get(header, set())
    own = os.path.dirname(path).replace("/Testing", "")
    allowed = {own, own + "/Testing", DATA_MODEL.rstrip("/")}
    if room == PLUGIN or not folders or folders & allowed:
        return None
    return f"{own} does not know {' or '.join(sorted(folders))}"


def check(root):
    index = header_index(root)
    count = 0
    faults = []
    for path in sources(root):
        count += 1
        with open(os.path.join(root, path), encoding="utf-8") as file:
            text = file.read()
        for match in INCLUDE.finditer(text):
            kind, header = match.groups()
            reason = fault(path, kind, header, index)
            if not reason and kind == '"' and header.startswith(("Kernels/", "Formats/")):
                top = "Filters" if header.startswith("Kernels/") else "Readers"
                if not os.path.isfile(os.path.join(root, top, header)):
                    reason = "there is no such file"
            if reason:
                line = text.count("\n", 0, match.start(1)) + 1
                faults.append(f"{path}:{line}: {header}: {reason}")
    return count, faults


def main():
    count, faults = check(sys.argv[1])
    for line in faults:
        print(line)
    if count == 0:
        print(f"{sys.argv[1]}: no sources found")
    print(f"{count} files, {len(faults)} includes against the direction")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
