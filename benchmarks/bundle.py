"""What a hysteretic contact remembers, as one would write it for another program: its elements.

Element l touches at the compression l and carries r dL, where L(l) = k l^p. It has r = 1 while it
is pressed further than ever since it touched, and r = (c/H)^(n - p) below the largest compression
H since then, which it forgets when it parts.
"""

import math
from itertools import pairwise


class Bundle:
    """The elements of one contact: those from each `low` to the next remember the same peak.

    Parameters
    ----------
    k, p, n : float
        Stiffness, and the exponents of loading and of unloading from one peak.
    """

    def __init__(self, k: float, p: float, n: float) -> None:
        self.k, self.p, self.fade = k, p, n - p
        self.forget()

    def forget(self) -> None:
        """Begin anew: the contact has opened."""
        self.rows = [(0.0, math.inf)]  # low and peak; an infinite peak is none

    @property
    def loading(self) -> bool:
        """Return whether the last elements are pressed further than ever since they touched."""
        return self.rows[-1][1] == math.inf

    @property
    def end(self) -> float:
        """The compression at which the present curve ends: 0 if the contact opens, inf for none."""
        if not self.loading:
            return self.rows[-1][0]
        return self.rows[-2][1] if len(self.rows) > 1 else math.inf

    def force(self, c: float) -> float:
        """Return the force at a compression above 0."""
        total = 0.0
        for (low, peak), (high, _) in pairwise([*self.rows, (c, 0.0)]):
            share = min(c / peak, 1.0) ** self.fade if peak < math.inf else 1.0
            total += self.k * (high**self.p - low**self.p) * share
        return total

    def turn(self, c: float) -> None:
        """Go on from c in the other direction."""
        if self.loading:
            self.rows[-1] = self.rows[-1][0], c
        else:
            self.rows.append((c, math.inf))

    def go_on(self) -> None:
        """Go on beyond the end of the present curve, in the same direction: a cycle is closed."""
        loading = self.loading
        self.rows.pop()
        if loading:
            self.rows[-1] = self.rows[-1][0], math.inf
