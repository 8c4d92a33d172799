"""Policies: from demonstrations of one movement to a control law (paper, section II-E).

============== =================================================================== =============== ==========
kind           what                                                                state           options
============== =================================================================== =============== ==========
path-following the course that the demonstrations share, followed at their speed   phase           repeat, pull, near
knn            the paper's: mean direction of the 50 nearest demonstrated points   none            neighbours
ilo-gmr        a mixture of Gaussians fitted to the nearest points at every call   none            neighbours
gmr            Gaussian mixture regression, the number of components chosen by BIC none            components
dmp            dynamic movement primitives: discrete reach, then the movement      phase, velocity repeat, frequency
============== =================================================================== =============== ==========

``path-following`` is the default; ``ilo-gmr`` is Cederborg et al. 2010, ``dmp`` Ijspeert et al. 2013.
"""

from __future__ import annotations

import inspect
import os
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from signimit.exceptions import FileFormatError, InvalidInputError, UnknownNameError
from signimit.policies.base import CONTROL_PERIOD as CONTROL_PERIOD
from signimit.policies.base import PlacedPolicy as PlacedPolicy
from signimit.policies.base import Policy as Policy
from signimit.policies.base import as_policy as as_policy
from signimit.policies.base import check_demonstrations
from signimit.policies.closed_loop import run_policy as run_policy
from signimit.policies.dmp import DMPPolicy as DMPPolicy
from signimit.policies.gmr import GMRPolicy as GMRPolicy
from signimit.policies.ilo_gmr import ILOGMRPolicy as ILOGMRPolicy
from signimit.policies.knn import KNearestPolicy as KNearestPolicy
from signimit.policies.path_following import PathFollowingPolicy as PathFollowingPolicy
from signimit.policies.storage import read_policy_arrays

_CLASSES = {cls.kind: cls for cls in (PathFollowingPolicy, KNearestPolicy, ILOGMRPolicy, GMRPolicy, DMPPolicy)}
POLICY_KINDS = tuple(_CLASSES)
DEFAULT_POLICY = PathFollowingPolicy.kind
StatefulPolicy = Policy  # its name in 0.1.0, when only some kinds had `start` and `step`


def make_policy(
    paths: Sequence[ArrayLike],
    times: Sequence[ArrayLike],
    kind: str = DEFAULT_POLICY,
    repeat: bool | None = None,
    **options: Any,
) -> Policy:
    """Learn a policy from demonstrations of one movement, seen from the object each was about (paper, section II-E).

    Args:
        paths: Hand positions, each of shape (T, 2), m, origin at the object.
        times: When the hand was there, each of shape (T,), s, strictly increasing.
        kind: One of `POLICY_KINDS`; ``"knn"`` is the paper's.
        repeat: Whether the movement goes round and round (True), or is made once, from its beginning, after which the
            hand rests (False). Left out, it repeats if most demonstrations come round again. Kinds that know no course
            (knn, gmr, ilo-gmr) cannot be told.
        **options: Settings of that kind, e.g. ``neighbours=20``. The table of `signimit.policies` has their names, the
            attributes of each kind's class say what they do.

    Returns:
        An immutable policy: ``policy(hand)`` maps positions, shape (2,) or (B, 2), m, to velocities, m/s.

    Raises:
        InvalidInputError: If a demonstration is not a timed path, or an option has a value that it cannot have.
        UnknownNameError: If there is no such kind, or it has no such option.
    """
    check_policy_kind(kind, repeat)
    if repeat is not None:
        options["repeat"] = bool(repeat)
    known = _options(kind)
    for name in options:
        if name not in known:
            raise UnknownNameError(f"option of policy kind {kind!r}", name, known)
    return _CLASSES[kind].learn(check_demonstrations(paths, times), **options)


def check_policy_kind(kind: str, repeat: bool | None = None) -> None:
    """Refuse a kind of policy that there is not, or that cannot be told whether its movement repeats.

    Raises:
        UnknownNameError: With the kinds there are, or the options of the kind.
        InvalidInputError: If ``repeat`` is neither a truth value nor None.
    """
    if kind not in POLICY_KINDS:
        raise UnknownNameError("policy kind", kind, POLICY_KINDS)
    if repeat is not None and not isinstance(repeat, bool | np.bool_):
        raise InvalidInputError("repeat", "True, False or None", repr(repeat))
    if repeat is not None and "repeat" not in _options(kind):
        raise UnknownNameError(f"option of policy kind {kind!r}", "repeat", _options(kind))


def _options(kind: str) -> list[str]:
    parameters = inspect.signature(_CLASSES[kind].learn).parameters.values()
    return [p.name for p in parameters if p.kind is p.KEYWORD_ONLY]


def load_policy(path: str | os.PathLike[str]) -> Policy:
    """Read a policy of any kind from the file that its ``save`` wrote.

    Raises:
        FileFormatError: If it is not a whole policy file, or of a kind that is not known here.
    """
    kind, arrays = read_policy_arrays(path)
    if kind not in _CLASSES:
        raise FileFormatError(os.fspath(path), f"a policy of kind {', '.join(POLICY_KINDS)}", repr(kind))
    return _CLASSES[kind].from_arrays(arrays, os.fspath(path))
