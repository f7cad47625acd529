#!/usr/bin/env python3
"""Fails where a proxy has no page, a page lacks a section, or a property is not explained.

usage: check_documentation.py ROOT
"""

import glob
import os
import re
import sys
import xml.etree.ElementTree as ElementTree

SECTIONS = ("## Mathematics", "## Inputs", "## Outputs", "## Properties", "## Example")


def proxies(root):
    """Name, XML file and element of every proxy of the plugin."""
    for path in sorted(glob.glob(os.path.join(root, "Plugin", "Proxies", "*.xml"))):
        for group in ElementTree.parse(path).getroot().iter("ProxyGroup"):
            for proxy in group:
                if proxy.tag.endswith("Proxy"):
                    yield proxy.get("name"), os.path.relpath(path, root), proxy


def properties(proxy):
    return [child for child in proxy if child.tag.endswith("Property")]


def spaced(name):
    """White Level of WhiteLevel: from which paraview.simple makes the Python name again."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[a-zA-Z])(?=[0-9])|(?<=[A-Z])(?=[A-Z][a-z])", " ", name)


def proxy_faults(path, proxy):
    if proxy.find("Documentation") is None:
        yield f"{path}: the proxy has no documentation"
    for item in properties(proxy):
        name = item.get("name")
        text = item.find("Documentation")
        if text is None or not (text.text or "").strip():
            yield f"{path}: the property {name} has no documentation"
        label = item.get("label", name)
        if re.sub(r"\W", "", label) != name:
            yield f"{path}: the property {name} has the label '{label}'; expected '{spaced(name)}'"


def page_faults(page, proxy, text):
    for section in SECTIONS:
        if not re.search(rf"^{section}\b", text, re.MULTILINE):
            yield f"{page}: there is no section '{section}'"
    if "```python" not in text:
        yield f"{page}: there is no example that starts with ```python"
    for item in properties(proxy):
        label = item.get("label", item.get("name"))
        if not re.search(rf"\b{re.escape(label)}\b", text):
            yield f"{page}: the property {label} is not explained"


def check(root):
    faults = []
    names = set()
    for name, path, proxy in proxies(root):
        names.add(name)
        faults += proxy_faults(path, proxy)
        page = os.path.join("Documentation", "Filters", name + ".md")
        try:
            with open(os.path.join(root, page), encoding="utf-8") as file:
                faults += page_faults(page, proxy, file.read())
        except FileNotFoundError:
            faults.append(f"{page}: no page for the proxy of {path}")
    for page in sorted(glob.glob(os.path.join(root, "Documentation", "Filters", "*.md"))):
        name = os.path.splitext(os.path.basename(page))[0]
        if name not in names and name != "README":
            faults.append(f"{os.path.relpath(page, root)}: there is no proxy {name}")
    return len(names), faults


def main():
    count, faults = check(sys.argv[1])
    for line in faults:
        print(line)
    print(f"{count} proxies, {len(faults)} faults")
    return 1 if faults or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
