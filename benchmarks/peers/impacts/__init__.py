"""Programs that answer the problems of `benchmarks/impacts`, each in a file of its own."""

from benchmarks.peers.impacts import (
    by_box2d,
    by_bullet,
    by_chipmunk,
    by_cvode,
    by_cyrk,
    by_heyoka,
    by_mujoco,
    by_scipy,
    ours,
)
from benchmarks.peers.impacts.common import Peer

PEERS: tuple[Peer, ...] = (
    ours.PEER,
    by_scipy.DOP853,
    by_scipy.RADAU,
    by_cyrk.PEER,
    by_cvode.PEER,
    by_heyoka.PEER,
    by_mujoco.PEER,
    by_chipmunk.PEER,
    by_bullet.PEER,
    by_box2d.PEER,
)
"""All of them, in the order of the table. To add one, write its file and name its `Peer` here."""
