"""Physics of many arms at once, on all threads."""

from __future__ import annotations

from importlib import resources
from threading import Lock
from types import TracebackType
from typing import Any, ClassVar

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

import signimit_assets
from signimit_envs.arm.batch.planar_arm import PlanarArm
from signimit_envs.arm.scene import CONTROL_RATE, SUBSTEPS

Array = NDArray[np.float64]


def compile_arm() -> mujoco.MjModel:
    """Compile the scene's arm without table, objects, cameras and shapes: the same motion in less time.

    Nothing collides, objects stay where they are put and the arm's inertia is given, so what is left out moves nothing:
    the joints agree to rounding.
    """
    with resources.as_file(resources.files(signimit_assets)) as folder:
        spec = mujoco.MjSpec.from_file(str(folder / "tabletop.xml"))
        for body in list(spec.worldbody.bodies):
            if body.name != "base":
                spec.delete(body)
        for shown in (*spec.geoms, *spec.cameras, *spec.lights, *spec.meshes, *spec.materials, *spec.textures):
            spec.delete(shown)
        return spec.compile()


class ManyArms:
    """B simulated arms whose joints track velocities, as the arm of `signimit_envs.TabletopEnv` does.

    Arrays have their components first and the B arms last.
    """

    def __init__(self, model: mujoco.MjModel, joints: Array, threads: int = 0) -> None:
        """Start the simulation with arms at rest.

        Args:
            model: The arm, or the scene with it.
            joints: Joint angles, shape (n, B), rad.
            threads: Number of threads that compute the physics; 0 for one a processor.
        """
        self._arm = PlanarArm.from_model(model)
        self._open(model, joints.shape[1], threads)
        self._qpos[:] = joints
        self._batch.forward()

    def _open(self, model: mujoco.MjModel, count: int, threads: int) -> None:
        self._batch = Batch(model, count, threads)
        self._qpos, self._qvel, self._ctrl = (self._batch.bind(name).T for name in ("qpos", "qvel", "ctrl"))

    def __getstate__(self) -> dict[str, Any]:
        """Return what a copy needs; MuJoCo's batches can be neither copied nor pickled."""
        batch = self._batch
        return {"arm": self._arm, "model": batch.model, "state": batch.state.copy(), "threads": batch.nthread}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Become a copy, with a batch of its own in the same state."""
        self._arm = state["arm"]
        self._open(state["model"], len(state["state"]), state["threads"])
        self._batch.state[:] = state["state"]

    @property
    def joints(self) -> Array:
        """Joint angles, shape (n, B), rad; a copy."""
        joints: Array = self._qpos.copy()
        return joints

    def simulate(self, velocities: Array) -> tuple[Array, NDArray[np.bool_]]:
        """Track joint velocities, shape (n, B), rad/s, for one control step, stopping at the joints' limits.

        Returns:
            Joint angles, shape (n, B), rad, and for which arms the physics succeeded, shape (B,); the others rest where
            they were before the step.
        """
        before = self._qpos.copy()
        room = (self._arm.lower - before) * CONTROL_RATE, (self._arm.upper - before) * CONTROL_RATE
        np.clip(velocities, *room, out=self._ctrl)
        # Fewer, longer steps would be faster, and all but the same until a drive's torque limit binds: then it hunts.
        self._batch.step(nstep=SUBSTEPS)
        sound: NDArray[np.bool_] = ~self._batch.warning[..., 1].any(axis=1)
        if not sound.all():
            self._qpos[:, ~sound], self._qvel[:, ~sound] = before[:, ~sound], 0.0
        return self.joints, sound


class QuietLog:
    """Context in which MuJoCo neither prints warnings nor writes MUJOCO_LOG.TXT.

    MuJoCo has one setting for the whole process. The first thread that enters keeps it and the last that leaves
    restores it, so that simulations in several threads do not restore each other's silence. To enter and leave costs
    about as much as a physics step: it is for many arms at once, and `signimit_envs.arm.arm` does without.
    """

    _lock: ClassVar[Lock] = Lock()
    _inside: ClassVar[int] = 0
    _usual: ClassVar[mujoco.MjLogConfig]

    def __enter__(self) -> None:
        """Silence MuJoCo."""
        with self._lock:
            if not QuietLog._inside:
                QuietLog._usual, silent = mujoco.MjLogConfig.get(), mujoco.MjLogConfig.get()
                silent.logto_file = silent.logto_console = False
                silent.set()
            QuietLog._inside += 1

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Let MuJoCo log as before, once all threads have left."""
        with self._lock:
            QuietLog._inside -= 1
            if not QuietLog._inside:
                QuietLog._usual.set()
