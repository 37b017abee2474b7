"""Simulated records as instruments write them, whose true values are known."""


def attributes(holds: str, form: str = "synthetic") -> dict[str, str]:
    """Return the attributes that `stackbounce.read` gives a record."""
    why = "it was made from a simulation"
    return {"format": form, "why": why, "doubt": "", "holds": holds, "source": ""}
