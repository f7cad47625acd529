"""Diagnosing a capture: its files, and the report's sections in words."""

import os
import re

from . import command, effect_sizes, gap_pictures, pipeline, report
from .gap_pictures import LIKELY

# The outputs of Sim To Real Gap; those that are kept as tables.
PORTS = {"summary": 0, "where": 1, "causes": 2, "candidates": 3, "heat-map": 4, "trend": 5, "samples": 6,
         "camera": 7, "notes": 8}
TABLES = ("where", "causes", "candidates", "heat-map", "trend", "samples")

VERDICTS = {
    "no gap": "The simulated and the real camera agree within noise.",
    "explained": "The two cameras disagree, and the causes below explain it: adding them to the simulation reduces the gap to little more "
                 "than noise.",
    "partly explained": "The two cameras disagree. The causes below explain a part of the gap; the cause of the remaining part was not found.",
    "unexplained": "The two cameras disagree, and no known effect explains the gap.",
}
AXES = {
    "channel": "some channels differ more than others, whatever the sample",
    "medium": "some media differ more than others",
    "scene": "some scenes differ more than others",
    "position": "the gap depends on the place in the field",
    "level": "the gap changes with the signal: bright and dark samples differ",
    "order": "the gap changes in the course of the capture",
    "spectral_shape": "the gap follows the slope and curvature of the reflectance, as where wavelengths are wrong",
    "sample": "single samples stand out",
    "edges": "the gap lies along edges, as where the channels' images are displaced or blurred",
    "rows": "the gap changes from row to row",
    "columns": "the gap changes from column to column",
    "region": "single regions of the image stand out",
}

# Where the causes remove this much of a gap and still are not sure.
FITS = 0.85
FITTED = ("The two cameras disagree. The causes below fit the data, but something that is not in the library may as well be behind "
          "what they do.")

# Probability from which the summary speaks of something that the library does not have.
UNKNOWN_IS_SAID = 0.2


class Diagnosis:
    """The outputs of a diagnosis by name; those that it does not have are empty.

    held: what took no part in finding the causes; axes: words for axes that are not those of samples."""

    def __init__(self, proxy, ports, held="samples", axes=None):
        self.proxy = proxy
        self.ports = ports
        self.held = held
        self.axes = {**AXES, **(axes or {})}
        self._known = {}
        self._names = None

    def port(self, name):
        return pipeline.port(self.proxy, self.ports[name])

    def records(self, name):
        """A table as a list of dictionaries; on rank 0, elsewhere empty."""
        if name not in self._known:
            names, rows = pipeline.table(self.port(name)) if name in self.ports else ([], [])
            self._known[name] = [dict(zip(names, row)) for row in rows]
        return self._known[name]

    def words(self, text):
        """Names of effects, axes and channels in a text as words: 'medium_gain' as 'Gain of one medium', 'C400' as '400 nm', 'C3' as
        'channel 3 (450 nm)' where the camera's curves tell."""
        if self._names is None:
            self._names = {name: title[:1].lower() + title[1:] for row in self.records("causes")
                           for name, title in zip(row["equivalent"].split(", "), row["equivalent_title"].split(", "))}
            self._names.update({row["effect"]: row["title"][:1].lower() + row["title"][1:]
                                for row in self.records("candidates") + self.records("causes")})
            self._names.update({axis: axis.replace("_", " ") for axis in self.axes})
            curves = self.records("camera")
            channels = [name for name in curves[0] if name.startswith("C")] if curves and "wavelength" in curves[0] else []
            self._names.update(report.channels(
                channels, {name: max(curves, key=lambda row: row[name])["wavelength"] for name in channels}))
        told = re.sub(r"\b[A-Za-z]\w*\b", lambda found: self._names.get(found[0], found[0]), text)
        return told.replace("channel channel", "channel")

    def summary(self):
        found = self.records("summary")
        return found[0] if found else {}

    def tables(self):
        return {name: self.records(name) for name in TABLES}


def folder_of(capture):
    """The capture's folder, also of the capture.json in it."""
    return os.path.dirname(capture) or "." if os.path.basename(capture) == "capture.json" else capture


def read_capture(folder, further=()):
    capture = pipeline.create("CaptureReader", FileName=folder, FurtherCaptures=list(further))
    pipeline.update(capture)
    pipeline.tell_notes(capture)
    return capture


def diagnose(capture, **options):
    gap = pipeline.create("SimToRealGap", Camera=pipeline.port(capture, 0),
                          Samples=pipeline.port(capture, 1), Responses=pipeline.port(capture, 2),
                          **options)
    pipeline.update(gap)
    return Diagnosis(gap, PORTS)


def write(gap, folder):
    """report.json, the corrected camera, the tables and the pictures."""
    pipeline.save("GapReportWriter", gap.port("summary"), os.path.join(folder, "report.json"))
    if "camera" in gap.ports:
        pipeline.save("CameraWriter", gap.port("camera"), os.path.join(folder, "camera-corrected.json"))
    for name in TABLES:
        if name in gap.ports:
            pipeline.save_table(gap.port(name), os.path.join(folder, f"{name}.csv"))
    tables, summary = gap.tables(), gap.summary()
    tables["heat-map"] = [{**row, "channel": gap.words(row["channel"])} for row in tables["heat-map"]]
    if command.rank() == 0:
        gap_pictures.draw_all(tables, summary, folder, gap.held)


def print_summary(gap):
    figures, causes = gap.summary(), first_rows(gap.records("causes"))
    if not figures:
        return
    command.say(f"Verdict: {figures['verdict']}")
    command.say(f"  {far(figures, gap.held)}")
    for line in mistakes(gap):
        command.say(f"  {line}")
    for line in cause_lines(figures, causes, gap):
        command.say(f"  {line}")
    if figures["next_capture"]:
        command.say(f"  Next capture: {next_capture(figures, gap)}")


def mistakes(gap):
    """Notes on what seems to be wrong with the capture itself, which begin with a question: look at these first."""
    return [row["note"] for row in gap.records("notes") if re.match(r"[A-Z][a-z ]*\?", row["note"])]


def next_capture(figures, gap):
    worth = ""
    if figures["expected_bits"] > 0:
        worth = f", expected {figures['expected_bits']:.1f} bits about the causes in " + \
            command.counted(round(figures["minutes"]), "minute")
    return f"{gap.words(figures['next_capture'])} (separates {gap.words(figures['separates'])}{worth})"


def first_rows(rows):
    """One row a cause, though a cause has a row for each parameter."""
    seen = {}
    for row in rows:
        seen.setdefault(row["rank"], row)
    return list(seen.values())


def far(figures, held="samples"):
    text = (f"rms {figures['rms_before']:.4f} before, {figures['rms_after']:.4f} after, noise alone "
            f"{figures['noise_floor']:.4f} (response, 1 = white; {held} held out)")
    if figures["verdict"] != "no gap":
        text += (f"; shrink {100 * figures['shrink']:.0f} % "
                 f"({100 * figures['shrink_low']:.0f} to {100 * figures['shrink_high']:.0f} %)")
    return text


def percent(share):
    return f"{100 * share:.0f} %" if share >= 0.005 else "under 1 %"


def size_of(cause, rows):
    """In words; rows: the table of causes."""
    return effect_sizes.in_words([row for row in rows if row["rank"] == cause["rank"]])


def cause_line(cause, gap):
    size = size_of(cause, gap.records("causes"))
    text = f"{title_of(cause)}{', ' if size else ''}{size}: {percent(cause['share'])} of the gap, probability {percent(cause['probability'])}"
    if cause["equivalent"]:
        text += f"; the data cannot distinguish it from {gap.words(cause['equivalent'])}"
    return text


def cause_lines(figures, causes, gap):
    """The causes, and something unknown before those that are less likely."""
    lines = [cause_line(cause, gap) for cause in causes]
    unknown = figures["unknown_probability"]
    if unknown >= UNKNOWN_IS_SAID:
        place = next((place for place, cause in enumerate(causes) if cause["probability"] < unknown), len(causes))
        lines.insert(place, f"An effect that is not in the library: probability {percent(unknown)}")
    return lines


def title_of(cause):
    return cause["title"] + (f" ({cause['medium']})" if cause["medium"] else "")


def lead(gap):
    """The result in one sentence."""
    figures, rows = gap.summary(), gap.records("causes")
    if not figures or figures["verdict"] == "no gap":
        return "The simulated and the real camera agree within noise." if figures else ""
    known, possible = [], []
    for cause in first_rows(rows):
        size = size_of(cause, rows)
        doubted = cause["probability"] < LIKELY
        chance = f", probability {percent(cause['probability'])}" if doubted else ""
        (possible if doubted else known).append(
            f"{title_of(cause)}{': ' if size else ''}{size} ({percent(cause['share'])} of the gap{chance})")
    words = [f"The simulated and the real camera differ by rms {figures['rms_before']:.4f} (response, 1 = white); after "
             f"correction, by {figures['rms_after']:.4f}."]
    words += mistakes(gap)
    unknown = figures["unknown_probability"]
    if unknown >= LIKELY:
        words.append(f"An effect that is not in the library is probably behind it (probability {percent(unknown)}).")
    for kind, found in (("Cause", known), ("Possible cause", possible)):
        if found:
            words.append(f"{kind}{'s' if len(found) > 1 else ''}: {'; '.join(found)}.")
    return " ".join(words if len(words) > 1 else [*words, "No known effect accounts for it."])


def sections(gap, folder):
    """The report: verdict, where, which, how far, what cannot be decided, how to go on."""
    figures, tables = gap.summary(), gap.tables()
    notes = [row["note"] for row in gap.records("notes")]
    if not figures:
        return []
    drawn = gap_pictures.drawn(folder)
    pages = [
        report.pictures("Before and after", folder, {
            "how-far.png": f"The gap before and after the causes are simulated, on {gap.held} that took no "
                           "part in finding them, against what noise alone makes"}),
        verdict_section(figures, first_rows(tables["causes"]), gap),
        *where_sections(tables["where"], figures, drawn, folder, gap),
        *which_sections(tables["causes"], figures, drawn, folder, gap),
        undecided_section(figures, first_rows(tables["causes"]), notes, gap)]
    if "camera" in gap.ports:
        pages.append(corrected_section(tables["causes"]))
    return pages


def corrected_section(causes):
    return report.text(
        "Going on with the corrected camera",
        "camera-corrected.json and camera-corrected.csv hold the simulated camera with the causes put back "
        "as effects: read camera-corrected.json as the camera of the filter Camera Simulator. report.json "
        "holds this page as data." if causes else
        "camera-corrected.json and camera-corrected.csv hold the camera as it was given: there was nothing "
        "to put back. report.json holds this page as data.")


def uncredited_lines(figures, gap):
    """What no cause is given: what is left of the gap, and what shrinks but may be another's."""
    share, left = figures["unexplained_share"], 1.0 - max(figures["shrink"], 0.0)
    if share < 0.005:
        return []
    where = gap.words(figures["unexplained_where"])
    place = "" if not where else f" ({where})" if where.startswith("no ") else f", most of it at {where}"
    if share <= left + 0.02:
        return [f"Left over: {100 * share:.0f} % of the gap{place}."]
    return [f"No cause accounts for {100 * share:.0f} % of the gap: {100 * left:.0f} % remains after the correction{place}; the "
            "rest is removed by effects that do not count as causes: \"What these data cannot decide, and why\" tells of them."]


def verdict_section(figures, causes, gap):
    fits = figures["verdict"] in ("partly explained", "unexplained") and figures["shrink"] >= FITS
    lines = [FITTED if fits else VERDICTS[figures["verdict"]], f"The gap: {far(figures, gap.held)}."]
    lines += mistakes(gap)
    lines += [f"{line}." for line in cause_lines(figures, causes, gap)]
    if causes:
        lines += uncredited_lines(figures, gap)
    if figures["rms_with_rest"] > 0:
        lines.append("In each channel a smooth function predicts a part of the gap that the causes leave; with it the rms is "
                     f"{figures['rms_with_rest']:.4f}. --add-rest (Add Rest in ParaView) adds it to the corrected simulator.")
    if figures["next_capture"]:
        lines.append(f"Next capture: {next_capture(figures, gap)}.")
    return report.text(f"Verdict: {figures['verdict']}", *lines)


def where_sections(where, figures, drawn, folder, gap):
    if figures["verdict"] == "no gap":
        words = ["There is no gap beyond noise; the pictures show how it is distributed."]
    else:
        axes = [row for row in where if not row["cell"] and row["share"] >= 0.05][:3]
        words = []
        for axis in axes:
            cells = [row for row in where if row["axis"] == axis["axis"] and row["cell"]][:3]
            worst = ", ".join(f"{gap.words(row['cell'])}: {100 * row['share']:.0f} %" for row in cells)
            name = axis["axis"].replace("_", " ")
            words.append(f"{name[:1].upper()}{name[1:]}, {100 * axis['share']:.0f} % of the gap's energy: "
                         f"{gap.axes.get(axis['axis'], '')}."
                         + (f" Largest parts: {worst}." if worst else ""))
        words = words or ["No axis stands out: the gap is spread evenly."]
    captions = {
        "axes.png": "How much of the gap's energy each axis predicts on what was held out; what two axes "
                    "have in common is shared between them",
        "where.png": "The gap of each channel and group of samples, before and after the correction",
        "map.png": "The gap over the field, relative to the simulated response, before and after",
        "trend.png": "The gap over the capture order, relative to the simulated response; the line is the "
                     "median between places where the level changes"}
    # The map of images has the page's whole width.
    whole = [report.pictures("Over the field", folder, {
        "gap-map.png": "The gap of the images channel by channel, real minus simulated: before above, after the "
                       "causes are simulated below. Purple: the real camera sees more light, orange: less"})
    ] if "gap-map.png" in drawn else []
    return [report.text("Where the gap lies", *words), *whole,
            report.pictures("Where, in pictures", folder,
                            {name: text for name, text in captions.items() if name in drawn})]


def which_sections(causes, figures, drawn, folder, gap):
    parts = []
    for cause in first_rows(causes):
        size = size_of(cause, causes)
        words = [cause["meaning"], *([f"Its size: {size}."] if size else []), f"As simulated: {cause['formula']}.",
                 f"Adding this effect to the simulation accounts for {percent(cause['share'])} of the gap; alone it would remove "
                 f"{100 * cause['shrink']:.0f} %.",
                 f"Probability that this effect is a cause, and not another or one that is not in the library: "
                 f"{percent(cause['probability'])}."]
        if cause["equivalent"]:
            words.append(f"These data cannot distinguish it from {gap.words(cause['equivalent'])}: each of them fits the {gap.held} "
                         f"held out equally well.")
        kind = "Cause" if cause["probability"] >= LIKELY else "Possible cause"
        parts.append(report.text(f"{kind} {cause['rank']}: {title_of(cause)}", *words))
    if not parts:
        parts = [report.text("Which effects cause it",
                             "None." if figures["verdict"] == "no gap" else
                             "None of the known effects: naming one would be a guess.")]
    columns = ["parameter", "value", "standard_error", "unit", "parameter_meaning"]
    rows = [[title_of(row), *("ratio" if name == "unit" and row[name] == "1" else row[name] for name in columns)]
            for row in causes if row["parameter"]]
    parts.append(report.table("Parameters of the causes", ["cause", "parameter", "value", "standard error", "unit", "meaning"],
                              rows))
    if "which.png" in drawn:
        parts.append(report.pictures("Which effects were tried", folder, {
            "which.png": "The causes found, each with the effects that the data cannot tell from it; and "
                         f"what each effect alone would do, with the 95 % interval over {gap.held}"}))
    return parts


def undecided_section(figures, causes, notes, gap):
    words = [f"{title_of(cause)}, or {gap.words(cause['equivalent'])}." for cause in causes if cause["equivalent"]]
    if figures["next_capture"]:
        words.append(f"What to capture next: {next_capture(figures, gap)}.")
        if "samples" in gap.ports:
            words.append("Afterwards diagnose both captures together: the same command with --also and the folder of the new "
                         "one.")
    words += [gap.words(note) for note in notes]
    return report.text("What these data cannot decide, and why",
                       *(words or ["Nothing limits the diagnosis."]))
