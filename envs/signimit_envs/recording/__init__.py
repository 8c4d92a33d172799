"""Recorded episodes: whole physics states, replayed exactly, in files of ours and in everybody's."""

from signimit_envs.recording.episodes import RecordedEpisode as RecordedEpisode
from signimit_envs.recording.episodes import Recording as Recording
from signimit_envs.recording.origin import STATE_SPEC as STATE_SPEC
from signimit_envs.recording.origin import RecordingOrigin as RecordingOrigin
from signimit_envs.recording.recorder import EpisodeRecorder as EpisodeRecorder
from signimit_envs.recording.replay import film_states as film_states
from signimit_envs.recording.replay import find_divergence as find_divergence
from signimit_envs.recording.replay import observe_states as observe_states
from signimit_envs.recording.reproductions import record_reproductions as record_reproductions
from signimit_envs.recording.storage import load_recording as load_recording
from signimit_envs.recording.storage import save_recording as save_recording
