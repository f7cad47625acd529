"""Writes CloseColors.txt: CIEDE2000 of nearly equal colors in 80 digits (mpmath), as Sharma, Wu and Dalal print the formula,
doi 10.1002/col.20070. TestCIEDE2000.cpp holds the kernel to them.

    reference_close_colors.py > CloseColors.txt
"""
import random

from mpmath import atan2, cos, exp, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 80


def radians(degrees):
    return degrees * pi / 180


def saturation(chroma):
    return sqrt(chroma ** 7 / (chroma ** 7 + mpf(25) ** 7))


def hue(a, b):
    return atan2(b, a) * 180 / pi % 360 if a or b else mpf(0)


def difference(first, second):
    (L1, a1, b1), (L2, a2, b2) = ([mpf(value) for value in color] for color in (first, second))
    G = (1 - saturation((sqrt(a1 ** 2 + b1 ** 2) + sqrt(a2 ** 2 + b2 ** 2)) / 2)) / 2
    a1, a2 = (1 + G) * a1, (1 + G) * a2
    C1, C2 = sqrt(a1 ** 2 + b1 ** 2), sqrt(a2 ** 2 + b2 ** 2)
    h1, h2 = hue(a1, b1), hue(a2, b2)
    turn, mean = h2 - h1, (h1 + h2) / 2
    if C1 * C2 == 0:
        turn, mean = mpf(0), h1 + h2
    elif abs(turn) > 180:
        turn += -360 if turn > 0 else 360
        mean += 180 if h1 + h2 < 360 else -180
    L, C = (L1 + L2) / 2, (C1 + C2) / 2
    dH = 2 * sqrt(C1 * C2) * sin(radians(turn / 2))
    T = (1 - mpf("0.17") * cos(radians(mean - 30)) + mpf("0.24") * cos(radians(2 * mean))
         + mpf("0.32") * cos(radians(3 * mean + 6)) - mpf("0.20") * cos(radians(4 * mean - 63)))
    l = (L2 - L1) / (1 + mpf("0.015") * (L - 50) ** 2 / sqrt(20 + (L - 50) ** 2))
    c = (C2 - C1) / (1 + mpf("0.045") * C)
    h = dH / (1 + mpf("0.015") * C * T)
    rotation = -sin(radians(60 * exp(-((mean - 275) / 25) ** 2))) * 2 * saturation(C)
    return sqrt(l ** 2 + c ** 2 + h ** 2 + rotation * c * h)


def main():
    source = random.Random(1)
    for apart in (1e-3, 1e-6, 1e-9, 1e-12):
        for kind in range(8):
            chroma = (0.01, 1.0, 30.0, 120.0)[kind % 4]
            angle = source.uniform(0.0, 6.28) if kind < 6 else 4.8  # the blue where hue and chroma rotate
            first = [source.uniform(0.0, 100.0), chroma * float(cos(angle)), chroma * float(sin(angle))]
            scale = apart * min(1.0, chroma)
            second = [value + scale * source.uniform(-1.0, 1.0) for value in first]
            if kind % 2:
                second[0] = first[0]
            print(*(repr(value) for value in first + second), nstr(difference(first, second), 20))


main()
