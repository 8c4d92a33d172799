"""Lessons: languages, scenes, people and what they do. Nothing that learns imports this package."""
