"""Recorded episodes with their physics states, which replay bit for bit.

============ ===================================================================================
``episodes`` `RecordedEpisode` and `Recording`, the arrays of one and of many episodes
``origin``   `RecordingOrigin`, the environment and the model that a recording needs for replay
``recorder`` `EpisodeRecorder`, a Gymnasium wrapper; `record_reproductions` of a model
``replay``   simulating, observing and filming recorded episodes again
``storage``  ``.npz`` files
``formats``  the same in CSV tables, Minari and LeRobot data sets; demonstrations too
============ ===================================================================================
"""

from signimit_envs.recording.episodes import RecordedEpisode as RecordedEpisode
from signimit_envs.recording.episodes import Recording as Recording
from signimit_envs.recording.origin import STATE_SPEC as STATE_SPEC
from signimit_envs.recording.origin import RecordingOrigin as RecordingOrigin
from signimit_envs.recording.recorder import EpisodeRecorder as EpisodeRecorder
from signimit_envs.recording.recorder import record_reproductions as record_reproductions
from signimit_envs.recording.replay import film_states as film_states
from signimit_envs.recording.replay import find_divergence as find_divergence
from signimit_envs.recording.replay import observe_states as observe_states
from signimit_envs.recording.storage import load_recording as load_recording
from signimit_envs.recording.storage import save_recording as save_recording
