"""Every method of estimation and every color difference is known wherever they are listed, in the registry's order; the sizes of effects are
told in plain words.

    check_methods.py ROOT
"""
import importlib.util
import pathlib
import re
import sys

KERNELS = "Filters/Kernels/Estimation"


def registered(root):
    """Names and labels in the order of the registry."""
    records = {}
    for path in sorted((root / KERNELS / "Methods").glob("*.cpp")):
        for function, name, label in re.findall(
                r"EstimationMethod (\w+)\(\)\s*\{\s*return \{ \"([^\"]+)\", \"([^\"]+)\"", path.read_text(encoding="utf-8")):
            records[function] = (name, label)
    registry = (root / KERNELS / "EstimationMethod.cpp").read_text(encoding="utf-8")
    return [records[function] for function in re.findall(r"(\w+Method)\(\)", registry) if function in records]


def faults_of(root):
    methods = registered(root)
    names = [name for name, _ in methods]
    if not methods:
        yield f"{KERNELS}/EstimationMethod.cpp: no methods are registered"
    xml = (root / "Plugin/Proxies/MetamerismCorrection.xml").read_text(encoding="utf-8")
    entries = re.search(r'name="Method".*?</EnumerationDomain>', xml, re.DOTALL).group(0)
    if re.findall(r'value="(\d+)" text="([^"]+)"', entries) != [
            (str(i), label) for i, (_, label) in enumerate(methods)]:
        yield "Plugin/Proxies/MetamerismCorrection.xml: the entries of Method are not the registry's"
    scripts = (root / "Plugin/Scripts/support/methods.py").read_text(encoding="utf-8")
    listed = scripts[scripts.index("NAMES = {"):scripts.index("}")]
    if re.findall(r'"([^"]+)": "([^"]+)"', listed) != methods:
        yield "Plugin/Scripts/support/methods.py: NAMES are not the registry's methods"
    page = (root / "Documentation/Filters/MethodComparison.md").read_text(encoding="utf-8")
    for name in names:
        if f"| `{name}` |" not in page:
            yield f"Documentation/Filters/MethodComparison.md: no row about the method {name}"
    tests = (root / KERNELS / "TestEstimationMethods.cpp").read_text(encoding="utf-8")
    for name in names:
        if f'"{name}"' not in tests:
            yield f"{KERNELS}/TestEstimationMethods.cpp: the method {name} is not tested"

    # Color differences: names and metrics.
    source = (root / "Filters/Kernels/Difference/ColorDifference.cpp").read_text(encoding="utf-8")
    differences = re.findall(r'\{ "([a-z0-9-]+)", "(dE\w+)", "', source)
    scripts = (root / "Plugin/Scripts/support/colors.py").read_text(encoding="utf-8")
    listed = scripts[scripts.index("DIFFERENCES = {"):scripts.index("}")]
    if not differences or re.findall(r'"([^"]+)": \("([^"]+)"', listed) != differences:
        yield "Plugin/Scripts/support/colors.py: DIFFERENCES are not the registry's color differences"
    page = (root / "Documentation/Filters/CIEDE2000Evaluator.md").read_text(encoding="utf-8")
    for name, metric in differences:
        if f"`{name}`" not in page or f"`{metric} D65`" not in page:
            yield f"Documentation/Filters/CIEDE2000Evaluator.md: no row about the color difference {name}"

    # Effects: their sizes in words, where there are any; else the report has the numbers alone.
    page = (root / "Documentation/CameraEffects.md").read_text(encoding="utf-8")
    sections = re.findall(r"^### (\w+)$(.*?)(?=^### |\Z)", page, re.MULTILINE | re.DOTALL)
    words = load(root / "Plugin/Scripts/support/effect_sizes.py")
    if not sections or not set(words.WORDS) <= {name for name, _ in sections}:
        yield "Plugin/Scripts/support/effect_sizes.py: WORDS are of effects that the registry does not have"
    for effect, section in ((name, text) for name, text in sections if name in words.WORDS):
        for form, parameters in re.findall(r"^\| `(\w+)` \|.*?\| (`.*) \|$", section, re.MULTILINE):
            for count in (1, 3) if "per channel" in parameters else (1,):
                rows = [{"effect": effect, "form": form, "parameter": name, "value": 1.2345 + 0.02 * k}
                        for name in re.findall(r"`(\w+)`(?: per channel)?: ", parameters) for k in range(count)]
                text = words.in_words(rows)
                if not re.search(r"\d", text) or re.search(r"[{}]|e[+-]\d", text):
                    yield f"Plugin/Scripts/support/effect_sizes.py: the size of {effect}, {form} is told as '{text}'"


def load(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def main():
    faults = list(faults_of(pathlib.Path(sys.argv[1])))
    print("\n".join(faults) or f"{len(registered(pathlib.Path(sys.argv[1])))} methods are known everywhere")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
