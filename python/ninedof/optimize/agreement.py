"""The chance of a better optimum, from the ends of the starts, in words."""

from __future__ import annotations

SURE = 0.95  # probability with which a better optimum would have been met


def least_share(completed: int) -> float:
    """Return the share of starts that a better optimum must attract to be met by `completed` starts with 95 %.

    Of an optimum that each start reaches with probability p, all n starts miss it with probability (1 - p)^n.
    """
    return float(1.0 - (1.0 - SURE) ** (1.0 / completed))


def agreement_words(completed: int, arrived: int, abandoned: int, optimal: bool) -> str:
    """Return how many starts were followed to their end, how many arrived, and what may have been missed.

    Parameters
    ----------
    completed, arrived, abandoned : int
        Starts followed to their end, those of them that ended at the best objective, and starts given up.
    optimal : bool
        Whether the best design is an optimum.

    """
    if completed < 1:
        return "no start was followed to its end"
    share = f"{'all' if arrived == completed else arrived or 'none'} of them to this optimum"
    if completed == 1:
        share = "to this optimum" if arrived else "not to this optimum"
    out = f"{completed} start{' was' if completed == 1 else 's were'} followed to the end"
    if optimal:
        out += f", {share}"
    if abandoned:
        others = f"{abandoned} other{' was' if abandoned == 1 else 's were'}"
        out += f"; {others} given up after a short run, having fallen behind, which proves nothing"
    if not optimal:
        return out
    which = "starts that are not given up" if abandoned else "starts"
    return (
        f"{out}. A better optimum to which {100.0 * least_share(completed):.0f} % of {which} lead would have been met "
        f"with a probability of {100.0 * SURE:.0f} %; a rarer one may have been missed"
    )
