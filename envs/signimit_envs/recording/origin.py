"""Origin of a recording: the environment's specification and the model, all that replay needs."""

from __future__ import annotations

import base64
import json
import os
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import gymnasium as gym
import mujoco
import numpy as np
from gymnasium.envs.registration import EnvSpec

from signimit import InvalidInputError
from signimit.display import one_line
from signimit.exceptions import FileFormatError
from signimit.validation import plain_text
from signimit_envs.arm.scene import SUBSTEPS, scene_assets, scene_xml
from signimit_envs.tabletop.env import TabletopEnv

STATE_SPEC = mujoco.mjtState.mjSTATE_INTEGRATION
"""Components of a recorded state: all that decides the next step. FULLPHYSICS lacks the positions of mocap bodies."""

_MAX_SUBSTEPS = 1000  # physics steps in a control step that a file may ask for
_MAX_FILES = 100  # assets that a file may name
_FILE = re.compile(r"""\bfile\w*\s*=\s*["']([^"']+)""")  # names of files that MuJoCo would read from this disk
_MULTIPLIED = re.compile(r"<\s*(replicate|composite|flexcomp)\b")  # MJCF that makes any number of bodies of one line
_TRUSTED = ("signimit_envs.", "gymnasium.wrappers.")  # modules whose code a file may name

HEADER, MODEL = "recording.json", "model.xml"
"""Files of `write_origin`."""


@one_line
@dataclass(frozen=True, kw_only=True)
class RecordingOrigin:
    """Environment and model of a recording.

    Attributes:
        env_spec: The environment's specification as `gymnasium.envs.registration.EnvSpec.to_json` writes it.
        model_xml: The model's MJCF.
        assets: Contents of the files that the MJCF names, by file name.
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
                cannot hold, or its model was changed after it was compiled.
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
        if _model_bytes(origin.compile_model()) != _model_bytes(arm.model):
            raise InvalidInputError("environment", "the model as it was compiled", "one that was changed since")
        return origin

    def compile_model(self) -> mujoco.MjModel:
        """Compile the recorded model.

        Raises:
            FileFormatError: If the MJCF does not compile, names files that are not in the recording, or has elements
                that are made many times over, which could take all memory.
        """
        for name in _FILE.findall(self.model_xml):
            if name not in self.assets:
                raise FileFormatError("recorded model", "no files but those recorded with it", repr(name))
        multiplied = _MULTIPLIED.search(self.model_xml)
        if multiplied:
            raise FileFormatError("recorded model", "bodies written one by one", f"the element {multiplied[1]!r}")
        try:
            return mujoco.MjModel.from_xml_string(self.model_xml, dict(self.assets))
        except (ValueError, RuntimeError, MemoryError, mujoco.FatalError) as error:  # the last three without memory
            found = " ".join(str(error).split()) or type(error).__name__
            raise FileFormatError("recorded model", "MJCF that compiles", found) from None

    def make_spec(self) -> EnvSpec:
        """Return the environment's specification, for `gymnasium.make`.

        Raises:
            FileFormatError: If it is no specification, or names code that is neither signimit's nor Gymnasium's: files
                come from strangers, and `gymnasium.make` calls what they name.
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
        """Return all attributes in JSON types, assets in base64."""
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
        """Make an origin from what `to_meta` returned.

        Raises:
            FileFormatError: If it is something else; the message begins with ``where``.
        """
        try:
            state, substeps = str(meta["state"]), int(meta["substeps"])
            texts = {name: str(meta[name]) for name in ("env_spec", "model_xml", "mujoco_version")}
            assets = {str(name): base64.b64decode(data, validate=True) for name, data in meta["assets"].items()}
            for text in texts.values():
                plain_text(text, where)
        except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as error:
            raise FileFormatError(where, "the environment and model of a recording", f"{error!r:.80}") from None
        if state != STATE_SPEC.name or not 1 <= substeps <= _MAX_SUBSTEPS:
            expected = f"states as {STATE_SPEC.name} and 1 to {_MAX_SUBSTEPS} substeps"
            raise FileFormatError(where, expected, f"{state} and {substeps}")
        return cls(assets=assets, substeps=substeps, **texts)

    def version_note(self) -> str:
        """Return a sentence on what may differ with this version of MuJoCo; empty if it is that of the recording."""
        if self.mujoco_version == mujoco.__version__:
            return ""
        return (
            f"Recorded with MuJoCo {self.mujoco_version}, this is {mujoco.__version__}: a simulation may differ "
            "from the recording; its states play as they were."
        )


def _model_bytes(model: mujoco.MjModel) -> bytes:
    buffer = np.empty(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return buffer.tobytes()


def write_origin(folder: Path, origin: RecordingOrigin, header: dict[str, Any]) -> None:
    """Write an origin as plain files: ``recording.json`` (header and environment), ``model.xml`` and its assets."""
    meta = {name: value for name, value in origin.to_meta().items() if name not in ("model_xml", "assets")}
    text = json.dumps({**header, "origin": {**meta, "assets": sorted(origin.assets)}}, indent=1)
    (folder / HEADER).write_text(text + "\n", encoding="utf-8")
    (folder / MODEL).write_bytes(origin.model_xml.encode("utf-8"))
    for name, data in origin.assets.items():
        (folder / name).write_bytes(data)


def read_origin(folder: Path, kind: str, version: int) -> tuple[RecordingOrigin, dict[str, Any]]:
    """Read the files of `write_origin`.

    Returns:
        The origin, and the header.

    Raises:
        FileFormatError: If a file or field is missing, or the header is of another kind or newer than ``version``.
    """
    where = os.fspath(folder / HEADER)
    try:
        header = json.loads((folder / HEADER).read_bytes())
        found, number = header["kind"], int(header["version"])
        if found != kind or number > version:
            raise FileFormatError(where, f"a {kind} of version <= {version}", f"{found} version {number}")
        meta = dict(header["origin"])
        names = [str(name) for name in meta.pop("assets")]
        xml = (folder / MODEL).read_bytes().decode("utf-8")
    except FileFormatError:
        raise
    except (OSError, ValueError, KeyError, TypeError, OverflowError, RecursionError) as error:
        raise FileFormatError(where, f"a whole {kind} of signimit", f"{error!r:.120}") from None
    for name in names:
        if name != Path(name).name or name in (HEADER, MODEL) or len(names) > _MAX_FILES:
            raise FileFormatError(where, "assets beside it", f"{name!r:.80}")
    origin = RecordingOrigin.from_meta({**meta, "model_xml": xml, "assets": {}}, where)
    try:
        assets = {name: (folder / name).read_bytes() for name in names}
    except OSError as error:
        raise FileFormatError(where, f"the asset {error.filename}", f"{error.strerror}") from None
    return RecordingOrigin(**{**vars(origin), "assets": assets}), header
