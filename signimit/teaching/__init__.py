"""Sessions and what they are made of: languages, scenes, people and their strokes. Nothing that learns imports it."""

from signimit.teaching.composition import GroundTruth as GroundTruth
from signimit.teaching.composition import compose_demonstrations as compose_demonstrations
from signimit.teaching.languages import PAPER_LANGUAGE as PAPER_LANGUAGE
from signimit.teaching.languages import Language as Language
from signimit.teaching.languages import Request as Request
from signimit.teaching.people.choosing import People as People
from signimit.teaching.people.choosing import Source as Source
from signimit.teaching.people.choosing import choose_people as choose_people
from signimit.teaching.sessions import Command as Command
from signimit.teaching.sessions import Condition as Condition
from signimit.teaching.sessions import Session as Session
from signimit.teaching.sessions import compose_session as compose_session
