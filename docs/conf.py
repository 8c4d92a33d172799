"""Sphinx configuration of the site: ``sh scripts/run.sh docs`` builds it into ``out/site``, offline."""

from __future__ import annotations

import os
import sys
from pathlib import Path

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS / "extensions"))
os.environ.setdefault("OMP_NUM_THREADS", "1")  # the arrays are small; threads only get into each other's way

from signimit import __version__ as version  # noqa: E402

project = "signimit"
author = copyright = "The signimit authors"
release = version

extensions = [
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.napoleon",
    "sphinx.ext.doctest",
    "sphinx.ext.viewcode",
    "myst_parser",
    "sphinx_copybutton",
    "sphinx_gallery.gen_gallery",
    "docstrings",
    "measured",
    "complete",
]
exclude_patterns = ["extensions"]
default_role = "py:obj"  # `learn` in a docstring is a link, where there is something of that name

# --- pages in Markdown
myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
suppress_warnings = ["config.cache"]

# --- the reference
autoclass_content = "both"
autodoc_member_order = "bysource"
autodoc_default_options = {"members": True, "special-members": "__call__"}
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented_params"
autodoc_typehints_format = "short"
autodoc_type_aliases = {name: name for name in ("ArrayLike", "Array", "NDArray", "Strokes", "Source", "Engine")}
autodoc_preserve_defaults = True
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 88
napoleon_numpy_docstring = False
napoleon_use_ivar = True
napoleon_custom_sections = [
    "Action space", "Observation space", "Reward", "Starting state", "Episode end", "Info", "Version history",
]  # fmt: skip
doctest_global_setup = "import numpy as np\nimport signimit as si\n"

# --- the tutorials, which are programs: each is run when its page is made
sphinx_gallery_conf = {
    "examples_dirs": "../examples/tutorials",
    "gallery_dirs": "tutorials",
    "filename_pattern": r"/\d_",
    "abort_on_example_error": True,
    "image_scrapers": ("tutorials.figures",),
    "reset_modules": ("tutorials.reset",),
    "reset_modules_order": "both",
    "capture_repr": ("_repr_html_", "__repr__"),
    "ignore_repr_types": r"matplotlib|'list'",
    "doc_module": ("signimit", "signimit_envs"),
    "reference_url": {"signimit": None, "signimit_envs": None},
    "backreferences_dir": "tutorials/uses",
    "show_memory": False,
    "min_reported_time": 1000,
    "show_signature": False,
    "remove_config_comments": True,
    "within_subsection_order": "FileNameSortKey",
    "write_computation_times": False,
}

# --- how it looks
html_theme = "furo"
html_title = "signimit"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_show_sphinx = False
pygments_style, pygments_dark_style = "tango", "monokai"
