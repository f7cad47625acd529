#!/usr/bin/env python3
"""Makes ArgyllReference.csv: tristimulus values by ArgyllCMS spec2cie, an independent program.

    python3 ArgyllReference.py > ArgyllReference.csv        (numpy, argyll; made with ArgyllCMS 2.3.1)

The reflectances are formulas, repeated in TestTristimulusTransform.cpp. A, D50 and D65 are ArgyllCMS's
own; FL2 is handed to it at 1 nm, interpolated from Data/Tables by cubic Lagrange polynomials and zero
outside the table, because ArgyllCMS has no FL2 and would hold its end values down to 360 nm.
spec2cie gives L*a*b* with respect to the ICC's D50 (96.42, 100, 82.49) whatever the illuminant.
"""
import pathlib
import subprocess
import tempfile

import numpy as np

TABLES = pathlib.Path(__file__).resolve().parents[3] / "Data" / "Tables"
GRIDS = [(400, 700, 10), (380, 730, 10), (380, 780, 5), (380, 780, 1), (400, 700, 20), (380, 780, 20)]
ILLUMINANTS = ["D65", "D50", "A", "FL2"]
OBSERVERS = {"2": "1931_2", "10": "1964_10"}


def bell(nm, center, width):
    return np.exp(-0.5 * ((nm - center) / width) ** 2)


def edge(nm, center, width):
    return 1.0 / (1.0 + np.exp(-(nm - center) / width))


def reflectances(nm):
    return np.array([
        np.full(nm.shape, 0.5),
        0.015 + 0.01 * edge(nm, 600, 20),
        0.05 + 0.80 * edge(nm, 590, 10),
        0.04 + 0.60 * bell(nm, 450, 35),
        0.05 + 0.50 * bell(nm, 530, 30),
        0.06 + 0.55 * edge(nm, 500, -12) + 0.30 * edge(nm, 660, 12),
    ])


def lagrange_at_1nm(table):
    nm, power = table.T
    fine = np.arange(360.0, 831.0)
    result = np.zeros(fine.size)
    for i, at in enumerate(fine):
        if nm[0] <= at <= nm[-1]:
            first = int(np.clip(np.searchsorted(nm, at, side="right") - 2, 0, nm.size - 4))
            nodes = nm[first:first + 4]
            for k in range(4):
                others = np.delete(nodes, k)
                result[i] += power[first + k] * np.prod((at - others) / (nodes[k] - others))
    return fine, result


def write_cgats(path, kind, keywords, fields, rows):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{kind}\n\nORIGINATOR \"reference\"\n")
        for key, value in keywords.items():
            file.write(f"{key} \"{value}\"\n")
        file.write(f"\nNUMBER_OF_FIELDS {len(fields)}\nBEGIN_DATA_FORMAT\n{' '.join(fields)}\n"
                   f"END_DATA_FORMAT\n\nNUMBER_OF_SETS {len(rows)}\nBEGIN_DATA\n")
        for row in rows:
            file.write(" ".join(row) + "\n")
        file.write("END_DATA\n")


def spectral(nm):
    keywords = {"SPECTRAL_BANDS": nm.size, "SPECTRAL_START_NM": nm[0], "SPECTRAL_END_NM": nm[-1],
                "SPECTRAL_NORM": 100.0}
    return keywords, [f"SPEC_{round(at):03d}" for at in nm]


def spec2cie(folder, nm, samples, illuminant, observer):
    keywords, bands = spectral(nm)
    fields = ["SAMPLE_ID", "XYZ_X", "XYZ_Y", "XYZ_Z", "RGB_R", "RGB_G", "RGB_B"] + bands
    rows = [[f"S{i}"] + ["0"] * 6 + [f"{100 * v:.10f}" for v in sample]
            for i, sample in enumerate(samples)]
    write_cgats(folder / "in.ti3", "CTI3",
                {"DEVICE_CLASS": "INPUT", "COLOR_REP": "XYZ_RGB", **keywords}, fields, rows)
    subprocess.run(["spec2cie", "-n", "-i", illuminant, "-o", observer, "in.ti3", "out.ti3"],
                   cwd=folder, check=True, stdout=subprocess.DEVNULL)
    text = (folder / "out.ti3").read_text(encoding="ascii")
    names = text.split("BEGIN_DATA_FORMAT")[1].split("END_DATA_FORMAT")[0].split()
    data = text.split("BEGIN_DATA\n")[1].split("END_DATA")[0].split("\n")[:len(samples)]
    wanted = [names.index(n) for n in ("XYZ_X", "XYZ_Y", "XYZ_Z", "LAB_L", "LAB_A", "LAB_B")]
    return [[line.split()[i] for i in wanted] for line in data]


def main():
    print("first,last,step,illuminant,observer,reflectance,X,Y,Z,L,a,b")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        fine, power = lagrange_at_1nm(
            np.loadtxt(TABLES / "illuminant_FL2.csv", delimiter=",", skiprows=1))
        keywords, bands = spectral(fine)
        write_cgats(folder / "FL2.sp", "SPECT", {"MEAS_TYPE": "EMISSION", **keywords}, bands,
                    [[f"{v:.9f}" for v in power]])
        for first, last, step in GRIDS:
            nm = np.arange(first, last + 1, step, dtype=float)
            for illuminant in ILLUMINANTS:
                for observer, option in OBSERVERS.items():
                    choice = "FL2.sp" if illuminant == "FL2" else illuminant
                    values = spec2cie(folder, nm, reflectances(nm), choice, option)
                    for i, row in enumerate(values):
                        print(f"{first},{last},{step},{illuminant},{observer},{i},{','.join(row)}")


if __name__ == "__main__":
    main()
