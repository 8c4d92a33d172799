"""File formats of recordings and demonstrations.

===================================================== ===================================================
``registry``                                          reading and writing by the name of a format
``columns``                                           the fields of a recording as columns of a table
``csv_recordings``                                    CSV tables
``minari_recordings``, ``minari_demonstrations``      Minari data sets, by way of ``minari_store``
``lerobot``                                           LeRobot data sets
===================================================== ===================================================

CSV tables of demonstrations need no simulator: `signimit.io.formats`.
"""

from signimit_envs.recording.formats.registry import FORMATS as FORMATS
from signimit_envs.recording.formats.registry import MINARI_PREFIX as MINARI_PREFIX
from signimit_envs.recording.formats.registry import Format as Format
from signimit_envs.recording.formats.registry import check_vacant_file as check_vacant_file
from signimit_envs.recording.formats.registry import detect_format as detect_format
from signimit_envs.recording.formats.registry import read_data as read_data
from signimit_envs.recording.formats.registry import read_recording as read_recording
from signimit_envs.recording.formats.registry import write_data as write_data
