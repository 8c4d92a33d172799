"""Demonstrations and recordings in everybody's formats: CSV tables, Minari, LeRobot, beside our own ``.npz``."""

from signimit_envs.recording.formats.registry import FORMATS as FORMATS
from signimit_envs.recording.formats.registry import MINARI_PREFIX as MINARI_PREFIX
from signimit_envs.recording.formats.registry import Format as Format
from signimit_envs.recording.formats.registry import check_vacant_file as check_vacant_file
from signimit_envs.recording.formats.registry import detect_format as detect_format
from signimit_envs.recording.formats.registry import read_data as read_data
from signimit_envs.recording.formats.registry import read_recording as read_recording
from signimit_envs.recording.formats.registry import write_data as write_data
