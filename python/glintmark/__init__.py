"""Results of glintmark as rows with units, and the standard figures of them.

>>> import glintmark
>>> runs = glintmark.read("results")          # every results.json in or below the folder
>>> glintmark.plot(runs, "zk16")              # bars over cases, a colour per run
>>> glintmark.tradeoff(runs, "gmm")           # error over time, the Pareto front

Without pandas `read` returns a list of dictionaries, with it a DataFrame; both have the same columns.
"""

from ._figures import plot, tradeoff
from ._read import SCHEMA, ResultsError, read, units

__all__ = ["SCHEMA", "ResultsError", "plot", "read", "tradeoff", "units"]
