"""What the commands promise of the files they write, without ParaView: support/outputs.py alone.

Argument: a folder for files."""

import fcntl
import os
import pathlib
import resource
import shutil
import socket
import subprocess
import sys

root = pathlib.Path(os.environ["MULTISPECTRAL_ROOT"])
sys.path.insert(0, str(root / "Plugin" / "Scripts"))
from support import command, outputs, report  # noqa: E402

command.rank = lambda: 0
os.environ.pop("MULTISPECTRAL_CHECK_OUTPUTS", None)  # which the other pipelines have
faults = []


def expect(condition, text):
    if not condition:
        faults.append(text)


def failure(action, *arguments):
    try:
        action(*arguments)
    except command.Failure as error:
        return str(error)
    return ""


def fresh(base, name):
    folder = base / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    forget()
    return folder


def forget():
    """As a new process would be."""
    outputs._inputs.clear()
    outputs._declared = outputs._old_report = None
    outputs._written.clear()
    for descriptor in outputs._locks:
        os.close(descriptor)
    outputs._locks.clear()


def inputs_are_not_written_over(base):
    folder = fresh(base, "inputs")
    measured = folder / "patches.csv"
    measured.write_text("sample,R400\na,0.5\n", encoding="utf-8")
    for given in (measured, folder / "." / "patches.csv", base / "inputs" / ".." / "inputs" / "patches.csv"):
        forget()
        outputs.reads(str(given))
        said = failure(outputs.claim, str(folder), ("report.html", "patches.csv"))
        expect("is an input, and the command would write" in said and str(given) in said, f"{given}: '{said}'")
    forget()
    link = base / "link.csv"
    link.unlink(missing_ok=True)
    link.symlink_to(measured)
    outputs.reads(str(link))
    expect(failure(outputs.claim, str(folder), ("*.csv",)), "an input behind a link was not recognized")
    expect(not failure(outputs.claim, str(folder), ("report.html",)), "refused although nothing is written over")
    # An output that was not foreseen is refused when it comes.
    expect(failure(outputs.write_text, str(measured), "x"), "the input was written over")
    expect(measured.read_text(encoding="utf-8").startswith("sample"), "the input was changed")


def partners_are_inputs(base):
    for given, other in (("cube.hdr", "cube.img"), ("cube.img", "cube.hdr"), ("camera.json", "camera.csv"),
                         ("camera.csv", "camera.json")):
        folder = fresh(base, "partners")
        for name in (given, other):
            (folder / name).write_text("x", encoding="utf-8")
        outputs.reads(str(folder / given))
        expect(failure(outputs.claim, str(folder), (other,)), f"{given} was read and {other} would be written over")


def one_run_at_a_time(base):
    folder = fresh(base, "busy")
    held = os.open(folder, os.O_RDONLY)
    fcntl.flock(held, fcntl.LOCK_EX)
    said = failure(outputs.claim, str(folder), ("report.html",))
    expect("another run writes into this folder" in said, f"busy: '{said}'")
    os.close(held)
    expect(not failure(outputs.claim, str(folder), ("report.html",)), "the folder is free and was refused")


def what_killed_runs_left_goes(base):
    folder = fresh(base, "stale")
    host = outputs._host()
    gone, alive = "4194309", str(os.getpid())  # above the kernel's largest process number
    names = {f".a.{host}-{gone}-0.part.csv": False, f".picture.{host}-{gone}-12.part.png": False,
             f".a.{host}-{alive}-0.part.csv": True, f".a.elsewhere-{gone}-0.part.csv": True, "a.csv": True}
    for name in names:
        (folder / name).write_text("half", encoding="utf-8")
    expect(host == outputs.re.sub(r"[/.-]", "_", socket.gethostname())[:16], "host")
    outputs.claim(str(folder), ("a.csv",))
    for name, stays in names.items():
        expect((folder / name).exists() == stays, f"{name} {'went' if stays else 'stayed'}")


def reports_are_in_words(_):
    for name, words in (("C400", "400 nm"), ("C402.5", "402.5 nm"), ("C3", "channel 3"), ("Coral", "Coral"), ("red", "red")):
        told = report.channels([name])[name]
        expect(told == words, f"{name} is {told}")
    expect(report.channels(["C3"], {"C3": 550.0})["C3"] == "channel 3 (550 nm)", "the wavelength of C3")
    many = [f"C{number}" for number in range(1, 201)]
    expect(report.channels(many, dict.fromkeys(many, 625.0))["C150"] == "channel 150 (625 nm)", "C150 of 200 channels is not at 150 nm")
    told = report.table("", ["channel"], [[name] for name in many])
    expect("channel 150" in told and " nm" not in told, "a table of 200 channels")
    expect("400 nm" in report.table("", ["channel"], [["C400"], ["C410"]]), "a table of wavelengths")
    page = report.figures("The fit", ["samples", "mean", "status"], [[24, 3e-19, "all is well"]])
    expect("<p>All is well.</p>" in page and "<td>0</td>" in page.replace(" class='text'", "") and "3e-19" not in page, f"figures: {page}")


def old_reports_go_with_the_first_result(base):
    folder = fresh(base, "report")
    report = folder / "report.html"
    report.write_text("old", encoding="utf-8")
    outputs.claim(str(folder), ("report.html", "a.csv"))
    expect(report.exists(), "the report went before there was anything new")
    outputs.write_text(str(folder / "a.csv"), "new")
    expect(not report.exists(), "the old report stands beside a new result")


def old_results_go_with_their_report(base):
    folder = fresh(base, "results")
    patterns = ("report.html", "*.png", "cube.img", "cube.hdr")
    outputs.claim(str(folder), patterns)
    for name in ("rgb.png", "it's <old>.png", "cube.img"):
        outputs.write_text(str(folder / name), "old")
    (folder / "cube.hdr").write_text("written with cube.img", encoding="utf-8")
    report.write(str(folder), "title", [])
    for name in ("mine.png", "notes.txt"):
        (folder / name).write_text("of the user", encoding="utf-8")
    forget()
    outputs.claim(str(folder), patterns)
    outputs.write_text(str(folder / "rgb.png"), "new")
    left = sorted(path.name for path in folder.iterdir())
    expect(left == ["mine.png", "notes.txt", "rgb.png"], f"left beside new results: {left}")


def incomplete_files_take_no_name(base):
    folder = fresh(base, "incomplete")
    outputs.claim(str(folder), ("a.png",))
    picture = folder / "a.png"

    def cut_off():
        with outputs.written(str(picture), outputs.END_OF_PNG) as part:
            pathlib.Path(part).write_bytes(b"\x89PNG half")
    said = failure(cut_off)
    expect("a.png: cannot be written" in said, f"cut off: '{said}'")

    def nothing():
        with outputs.written(str(picture)):
            pass
    expect(failure(nothing), "a writer that wrote nothing went unnoticed")
    expect(not list(folder.iterdir()), f"left: {list(folder.iterdir())}")

    (folder / "state.pvsm").mkdir()
    said = failure(outputs.write_text, str(folder / "state.pvsm"), "x")
    expect("state.pvsm: cannot be written: Is a directory" in said, f"a folder in the way: '{said}'")


def a_full_disk_is_said(base):
    """A limit of the file size stands for it: a write comes back with an error all the same."""
    folder = fresh(base, "full")
    limit = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (1000, limit[1]))
    try:
        said = failure(outputs.write_text, str(folder / "a.html"), "x" * 100_000)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limit)
    expect("a.html: cannot be written: File too large" in said, f"full: '{said}'")
    expect(not list(folder.iterdir()), f"left: {list(folder.iterdir())}")


def outputs_are_declared(base):
    folder = fresh(base, "declared")
    os.environ["MULTISPECTRAL_CHECK_OUTPUTS"] = "1"
    outputs.claim(str(folder), ("a.csv", "images/*.png"))
    for name, known in (("a.csv", True), ("b.csv", False), ("x.png", False), ("images/x.png", True)):
        try:
            outputs.check(str(folder / name))
            expect(known, f"{name} is not declared")
        except AssertionError:
            expect(not known, f"{name} is declared")
    del os.environ["MULTISPECTRAL_CHECK_OUTPUTS"]


def names_are_printed_safely(_):
    expect(command.printable("a\x1b[2Jb\x7f\x9bc\tü\n") == "a\\x1B[2Jb\\x7F\\x9Bc\tü\n", "printable")
    latin = os.fsdecode(b"caf\xe9.csv")
    said = failure(outputs.reads, latin)
    expect(said == "caf\\xE9.csv: the name is not UTF-8; rename the file or its folder", f"Latin-1: '{said}'")


def one_rank_speaks(base):
    """MPI kills all ranks as soon as one has failed: the others wait for the first one's word, and who has it speaks."""
    code = ("import sys; sys.path.insert(0, sys.argv[1]); from support import command; command._GRACE = 0.2; "
            "command.rank = lambda: int(sys.argv[2]); command.leave('it failed', 1)")
    word = base / "word"
    word.touch()
    for environment, rank, text in (({}, "0", "multispectral: it failed\n"), ({}, "1", "multispectral: it failed\n"),
                                    ({"MULTISPECTRAL_WORD": str(word)}, "1", "multispectral: it failed\n"),
                                    ({"MULTISPECTRAL_WORD": str(word)}, "0", ""), ({"MULTISPECTRAL_WORD": str(word)}, "2", "")):
        done = subprocess.run([sys.executable, "-c", code, str(root / "Plugin" / "Scripts"), rank], text=True,
                              stderr=subprocess.PIPE, env={**os.environ, "OMPI_COMM_WORLD_RANK": rank, **environment})
        expect(done.returncode == 1 and done.stderr == text, f"rank {rank}: {done}")


def pages_speak_in_words(base):
    """Columns and metrics in words, what the data name as it is; long tables folded; a chapter's sections one level lower."""
    names = ["sample", "metric", "p95", "left_out"]
    rows = [["dE00 of p95", "dE00", 1.5, 0]] * 13
    table = report.table("Errors", names, rows)
    for part in (">95th percentile</th>", ">left out</th>", ">\u0394E00</td>", ">dE00 of p95</td>", "<summary>13 rows</summary>"):
        expect(part in table, f"{part} is not in the table {table[:600]}")
    expect("<details>" not in report.table("Errors", names, rows[:12]), "a short table is folded")
    expect(report.in_words("dE00 D65") == "\u0394E00 D65" and report.in_words("rms") == "rms", "names of maps")
    page = report.chapter("Chapter", [table], "a < b")
    expect(page.count("<h2>") == 1 and "<h3>Errors</h3>" in page and "<p>a &lt; b</p>" in page, f"a chapter is {page[:300]}")
    folder = base / "page"
    folder.mkdir(exist_ok=True)
    report.write(str(folder), "Title", [page], "The result in one sentence.")
    text = (folder / "report.html").read_text(encoding="utf-8")
    expect(text.index("The result in one sentence.") < text.index("<h2>"), "the result does not come first")


def main():
    base = pathlib.Path(sys.argv[1])
    base.mkdir(parents=True, exist_ok=True)
    for test in (reports_are_in_words, inputs_are_not_written_over, partners_are_inputs, one_run_at_a_time, what_killed_runs_left_goes,
                 old_reports_go_with_the_first_result, old_results_go_with_their_report, incomplete_files_take_no_name,
                 a_full_disk_is_said, outputs_are_declared, names_are_printed_safely, one_rank_speaks,
                 pages_speak_in_words):
        test(base)
    print("\n".join(faults) or "inputs stay, outputs are complete or absent")
    sys.exit(1 if faults else 0)


main()
