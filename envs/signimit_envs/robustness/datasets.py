"""Mutation of data sets: other columns in Parquet, other arrays in HDF5."""

from __future__ import annotations

import importlib
import io
from typing import Any

import numpy as np

from signimit_envs.robustness.archives import mutate_array
from signimit_envs.robustness.mutation import Rng, mutate_bytes, pick


def mutate_parquet(content: bytes, rng: Rng) -> bytes:
    """Change a column of a table: its numbers, type, nulls or name; or the bytes of the file."""
    pa, pq = (importlib.import_module(name) for name in ("pyarrow", "pyarrow.parquet"))

    if not rng.integers(3):
        return mutate_bytes(content, rng)
    table = pq.read_table(io.BytesIO(content))
    at = int(rng.integers(len(table.column_names)))
    name, column = table.column_names[at], table.column(at)
    match int(rng.integers(7)):
        case 0:
            table = table.remove_column(at)
        case 1:
            table = table.slice(0, int(rng.integers(table.num_rows + 1)))
        case 2:
            table = pa.concat_tables([table, table.slice(0, 1)])
        case 3:
            table = table.rename_columns([name + "x" if name == other else other for other in table.column_names])
        case 4:
            values = column.to_pylist()
            values[int(rng.integers(len(values)))] = None
            table = table.set_column(at, name, pa.array(values, column.type))
        case _:
            table = table.set_column(at, name, _other_column(pa, column, rng))
    buffer = io.BytesIO()
    pq.write_table(table, buffer)
    return buffer.getvalue()


def _other_column(pa: Any, column: Any, rng: Rng) -> Any:
    """Return a column of other numbers, of another type, or of lists of other lengths."""
    array = np.array(column.to_pylist())
    changed = mutate_array(array, rng) if array.dtype.kind in "biufU" else array
    rows = (
        [changed[i % len(changed)] for i in range(len(column))] if changed.ndim and len(changed) else [0] * len(column)
    )
    values = [value.tolist() for value in np.asarray(rows)]
    return pa.array(values)


def mutate_hdf5(content: bytes, rng: Rng) -> bytes:
    """Change, remove, rename or replace a dataset or an attribute in an HDF5 file; or its bytes."""
    h5py: Any = importlib.import_module("h5py")

    if not rng.integers(3):
        return mutate_bytes(content, rng)
    buffer = io.BytesIO(content)
    with h5py.File(buffer, "r+") as file:
        names: list[str] = []
        file.visit(names.append)
        name = pick(rng, names)
        item = file[name]
        match int(rng.integers(6)):
            case 0:
                del file[name]
            case 1:
                file.move(name, name + "x")
            case 2 if item.attrs:
                key = pick(rng, list(item.attrs))
                item.attrs[key] = pick(rng, ("text", -1, 10**9, 1.5, np.zeros(3), b"\xff"))
            case _ if isinstance(item, h5py.Dataset):
                changed = mutate_array(item[()], rng) if item.dtype.kind in "biuf" else np.zeros(3)
                del file[name]
                file[name] = changed
            case _:
                del file[name]
                file[name] = np.zeros((2, 2))
    return buffer.getvalue()
