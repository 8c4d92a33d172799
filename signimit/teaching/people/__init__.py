"""Synthetic people and what they draw; their strokes are called synthetic wherever they appear."""

from signimit.teaching.people.glyphs import GOAL_LABELS as GOAL_LABELS
from signimit.teaching.people.glyphs import MOVEMENT_LABELS as MOVEMENT_LABELS
from signimit.teaching.people.glyphs import SIGN_LABELS as SIGN_LABELS
from signimit.teaching.people.person import Person as Person
from signimit.teaching.people.person import Style as Style
from signimit.teaching.people.person import drawings as drawings
from signimit.teaching.people.person import synthetic_library as synthetic_library
