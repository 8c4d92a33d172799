"""Where a recording comes from: the environment's specification and the model, complete enough to need nothing else."""

from __future__ import annotations

import base64
import re
from dataclasses import dataclass, field
from typing import Any

import gymnasium as gym
import mujoco
import numpy as np
from gymnasium.envs.registration import EnvSpec

from signimit import InvalidInputError
from signimit.exceptions import FileFormatError
from signimit_envs.arm.scene import SUBSTEPS, scene_assets, scene_xml
from signimit_envs.tabletop.env import TabletopEnv

STATE_SPEC = mujoco.mjtState.mjSTATE_INTEGRATION
"""What a recorded state holds: all that decides the next step. FULLPHYSICS lacks where the objects (mocap) are."""

_MAX_SUBSTEPS = 1000
_FILE = re.compile(r"""\bfile\w*\s*=\s*["']([^"']+)""")  # MuJoCo would look for it on this disk
_TRUSTED = ("signimit_envs.", "gymnasium.wrappers.")


@dataclass(frozen=True, kw_only=True)
class RecordingOrigin:
    """What has to be known to replay a recording.

    Attributes:
        env_spec: The environment's specification as `gymnasium.envs.registration.EnvSpec.to_json` writes it.
        model_xml: The MJCF that was compiled.
        assets: The files that it names.
        mujoco_version: Version of the simulator.
        substeps: Physics steps in a control step.
    """

    env_spec: str
    model_xml: str
    assets: dict[str, bytes] = field(repr=False)
    mujoco_version: str = mujoco.__version__
    substeps: int = SUBSTEPS

    @classmethod
    def of(cls, env: gym.Env[Any, Any]) -> RecordingOrigin:
        """Describe one of signimit's environments, wrapped or not.

        Raises:
            InvalidInputError: If it is another environment, was not made by `gymnasium.make`, has arguments that JSON
                cannot say, or its model was changed after it was compiled.
        """
        arm = env.unwrapped
        if not isinstance(arm, TabletopEnv):
            raise InvalidInputError("environment", "one of signimit's", type(arm).__name__)
        if env.spec is None:
            raise InvalidInputError("environment", "one that gymnasium.make made", "one without a specification")
        try:
            env_spec = env.spec.to_json()
        except (TypeError, ValueError) as error:
            raise InvalidInputError("environment", "arguments that JSON can say", str(error)) from None
        origin = cls(env_spec=env_spec, model_xml=scene_xml(arm.model.nmocap), assets=scene_assets())
        if _bytes(origin.compile_model()) != _bytes(arm.model):
            raise InvalidInputError("environment", "the model as it was compiled", "one that was changed since")
        return origin

    def compile_model(self) -> mujoco.MjModel:
        """Compile the recorded model.

        Raises:
            FileFormatError: If MuJoCo cannot, or the model names files that are not in the recording.
        """
        for name in _FILE.findall(self.model_xml):
            if name not in self.assets:
                raise FileFormatError("recorded model", "no files but those recorded with it", repr(name))
        try:
            return mujoco.MjModel.from_xml_string(self.model_xml, dict(self.assets))
        except ValueError as error:
            raise FileFormatError("recorded model", "MJCF that compiles", " ".join(str(error).split())) from None

    def make_spec(self) -> EnvSpec:
        """Return the environment's specification, for `gymnasium.make`.

        Raises:
            FileFormatError: If it is none, or names code that is neither signimit's nor Gymnasium's: files come from
                strangers, and to make an environment is to call what they name.
        """
        try:
            spec = EnvSpec.from_json(self.env_spec)
            entries = [spec.entry_point, *(wrapper.entry_point for wrapper in spec.additional_wrappers)]
        except (ValueError, TypeError, AttributeError, KeyError) as error:
            raise FileFormatError("recorded environment", "a Gymnasium specification", f"{error!r:.80}") from None
        for entry in entries:
            if not str(entry).startswith(_TRUSTED):
                raise FileFormatError("recorded environment", "code of signimit_envs or gymnasium", f"{entry!r:.80}")
        return spec

    def to_meta(self) -> dict[str, Any]:
        """Return everything as what JSON can say."""
        return {
            "env_spec": self.env_spec,
            "model_xml": self.model_xml,
            "assets": {name: base64.b64encode(data).decode("ascii") for name, data in self.assets.items()},
            "mujoco_version": self.mujoco_version,
            "substeps": self.substeps,
            "state": STATE_SPEC.name,
        }

    @classmethod
    def from_meta(cls, meta: Any, where: str) -> RecordingOrigin:
        """Undo `to_meta`, complaining about ``where`` if that cannot be."""
        try:
            state, substeps = str(meta["state"]), int(meta["substeps"])
            texts = {name: str(meta[name]) for name in ("env_spec", "model_xml", "mujoco_version")}
            assets = {str(name): base64.b64decode(data, validate=True) for name, data in meta["assets"].items()}
        except (KeyError, TypeError, ValueError, AttributeError) as error:
            raise FileFormatError(where, "the environment and model of a recording", f"{error!r:.80}") from None
        if state != STATE_SPEC.name or not 1 <= substeps <= _MAX_SUBSTEPS:
            expected = f"states as {STATE_SPEC.name} and 1 to {_MAX_SUBSTEPS} substeps"
            raise FileFormatError(where, expected, f"{state} and {substeps}")
        return cls(assets=assets, substeps=substeps, **texts)

    def version_note(self) -> str:
        """Say what may differ because MuJoCo is another version than at recording; empty if it is the same."""
        if self.mujoco_version == mujoco.__version__:
            return ""
        return (
            f"Recorded with MuJoCo {self.mujoco_version}, this is {mujoco.__version__}: a simulation may differ "
            "from the recording; its states play as they were."
        )


def _bytes(model: mujoco.MjModel) -> bytes:
    buffer = np.empty(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return buffer.tobytes()
