"""The methods of estimation: their names on the command line and in the filter Metamerism Correction.

The order and the names are those of the registry (Filters/Kernels/Estimation/EstimationMethod.h); a structure test
compares them."""

NAMES = {"direct": "Direct", "pinv": "PINV", "pooled": "Pooled", "r-model": "R-model", "banded": "Banded",
         "transfer": "Transfer", "wiener": "Wiener", "adaptive-wiener": "Adaptive Wiener",
         "pca": "Principal components", "kernel-ridge": "Kernel ridge", "local-linear": "Local linear",
         "polynomial": "Polynomial", "root-polynomial": "Root-polynomial", "sparse": "Sparse"}

# What each estimates from, for those who read a report. The pages of the filters say more.
MEANINGS = {"direct": "calibrated on the chart alone", "pinv": "calibrated on the tuning samples alone",
            "pooled": "calibrated on chart and tuning samples together",
            "r-model": "the chart's estimate, corrected in each band by the tuning samples",
            "banded": "responses corrected in each channel by the tuning samples, then calibrated on both (the published method)",
            "transfer": "statistical transfer from the chart to the material, with uncertainty",
            "wiener": "least squares with the covariance of the samples as prior", "adaptive-wiener": "Wiener on the most similar samples",
            "pca": "few principal components of the samples", "kernel-ridge": "kernel ridge regression",
            "local-linear": "linear regression on the most similar samples", "polynomial": "linear in products of responses",
            "root-polynomial": "linear in roots of products of responses", "sparse": "linear with few coefficients (L1)"}

# The source's methods and the project's own: what is compared unless the user asks for others.
COMPARED = ("direct", "pinv", "pooled", "r-model", "banded", "transfer")


def chosen(text):
    """The methods of a list separated by commas or blanks; "all" is every method."""
    names = text.replace(",", " ").split()
    return list(NAMES) if names == ["all"] else names
