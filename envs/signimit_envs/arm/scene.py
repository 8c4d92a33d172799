"""The MuJoCo scene, and the constants of table and arm."""

from __future__ import annotations

from importlib import resources
from xml.etree import ElementTree

import mujoco
import numpy as np
from numpy.typing import NDArray

import signimit_assets
from signimit import InvalidInputError
from signimit.policies import CONTROL_PERIOD

WORKSPACE = np.array([0.42, 0.38])  # m, half sizes of the area in which the hand reaches every position
TABLE = np.array([0.56, 0.50])  # m, half sizes of the table's top
CONTROL_RATE = round(1 / CONTROL_PERIOD)  # Hz
SUBSTEPS = 20  # physics steps in a control step
MAX_JOINT_SPEED = 3.5  # rad/s, limit of the drives
MAX_HAND_SPEED = 1.2  # m/s along each axis; what an action of 1 stands for with hand control
POSTURE_COST = 1e-4  # against 1 for the hand; more would make a resting hand creep, 1e-2 bend its way
POSTURE_STRIDE = 0.05  # m a step of the search for a posture at most: over more the arm is far from linear
POSTURE_ITERATIONS = 60  # steps of that search at most
POSTURE_TOLERANCE = 1e-9  # rad; the search ends with a step in which no joint turns more
OBJECT_COUNTS = range(2, 7)
for _array in (WORKSPACE, TABLE):
    _array.setflags(write=False)

_EXTRA_OBJECTS = (  # colour, rgba, geom type, size (m), height of the centre (m)
    ("violet", (0.50, 0.30, 0.68, 1), "ellipsoid", (0.042, 0.042, 0.046), 0.0),
    ("orange", (0.88, 0.46, 0.10, 1), "box", (0.050, 0.020, 0.022), 0.022),
    ("teal", (0.10, 0.56, 0.58, 1), "sphere", (0.022, 0.0, 0.0), 0.022),
)
OBJECT_NAMES = ("red", "green", "blue", *(name for name, *_ in _EXTRA_OBJECTS))


def compile_scene(objects: int = 3) -> mujoco.MjModel:
    """Compile the model of table, arm and objects.

    Args:
        objects: Number of objects, 2 to 6; `OBJECT_NAMES` has their colours.

    Raises:
        InvalidInputError: If the number of objects is not 2 to 6.
    """
    return mujoco.MjModel.from_xml_string(scene_xml(objects), scene_assets())


def scene_xml(objects: int = 3) -> str:
    """Write the MJCF that `compile_scene` compiles; with `scene_assets` it needs no other file.

    Raises:
        InvalidInputError: If the number of objects is not 2 to 6.
    """
    check_object_count(objects)
    root = ElementTree.fromstring((resources.files(signimit_assets) / "tabletop.xml").read_bytes())
    (world,) = root.iter("worldbody")
    for body in world.findall("body[@mocap='true']")[objects:]:
        world.remove(body)
    for number in range(3, objects):
        _, rgba, shape, size, height = _EXTRA_OBJECTS[number - 3]
        body = ElementTree.SubElement(world, "body", name=f"object_{number}", mocap="true")
        numbers = {"size": size, "pos": (0, 0, height), "rgba": rgba}
        texts = {name: " ".join(map(str, values)) for name, values in numbers.items()}
        ElementTree.SubElement(body, "geom", {"type": shape, **texts})
    return ElementTree.tostring(root, encoding="unicode")


def check_object_count(objects: object) -> None:
    """Check a number of objects.

    Raises:
        InvalidInputError: If it is not 2 to 6.
    """
    if not isinstance(objects, int | np.integer) or objects not in OBJECT_COUNTS:
        raise InvalidInputError("objects", f"{OBJECT_COUNTS[0]} to {OBJECT_COUNTS[-1]}", repr(objects))


def scene_assets() -> dict[str, bytes]:
    """Return the content of the files that the MJCF names, by file name."""
    return {"wood.png": (resources.files(signimit_assets) / "wood.png").read_bytes()}


def object_bodies(model: mujoco.MjModel) -> list[int]:
    """Return the mocap numbers of the objects, in order."""
    count = model.nmocap
    return [int(model.body_mocapid[model.body(f"object_{number}").id]) for number in range(count)]


def home_posture(model: mujoco.MjModel) -> NDArray[np.float64]:
    """Return the joint angles of the posture that the arm prefers, shape (3,), rad."""
    return np.array(model.key("home").qpos)


def hand_action(velocity: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the actions with ``control="hand"`` for velocities of hands, both of shape (..., 2), m/s.

    A velocity beyond the arm's is slowed down as a whole, so that its direction stays.

    Raises:
        InvalidInputError: If they are of another shape.
    """
    if velocity.shape[-1:] != (2,):
        raise InvalidInputError("policy", "velocities along x and y", f"shape {velocity.shape}")
    action: NDArray[np.float64] = velocity / np.maximum(MAX_HAND_SPEED, np.abs(velocity).max(axis=-1, keepdims=True))
    return action
