"""The methods of estimation: their names on the command line and in the filter Metamerism Correction."""

NAMES = {"direct": "Direct", "pinv": "PINV", "pooled": "Pooled", "r-model": "R-model", "banded": "Banded",
         "transfer": "Transfer"}
