"""The methods of estimation: their names on the command line and in the filter Metamerism Correction.

The order and the names are those of the registry (Filters/Kernels/Estimation/EstimationMethod.h); a structure test
compares them."""

NAMES = {"direct": "Direct", "pinv": "PINV", "pooled": "Pooled", "r-model": "R-model", "banded": "Banded",
         "transfer": "Transfer", "wiener": "Wiener", "adaptive-wiener": "Adaptive Wiener",
         "pca": "Principal components", "kernel-ridge": "Kernel ridge", "local-linear": "Local linear",
         "polynomial": "Polynomial", "root-polynomial": "Root-polynomial", "sparse": "Sparse"}

# The source's methods and the project's own: what is compared unless the user asks for others.
COMPARED = ("direct", "pinv", "pooled", "r-model", "banded", "transfer")


def chosen(text):
    """The methods of a list separated by commas or blanks; "all" is every method."""
    names = text.replace(",", " ").split()
    return list(NAMES) if names == ["all"] else names
