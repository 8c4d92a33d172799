"""Faults from outside, made on purpose: mutated files for every loader, killed writers, full disks.

============= ======================================================================
``mutation``  bytes, text, JSON and data sets with something wrong in them
``archives``  archives of arrays (``.npz``) with something wrong in them
``samples``   small valid files of every kind, written by the project itself
``loaders``   every loader of the project: its samples, and what one does with what it read
``fuzzing``   loaders read and use mutated files, in processes that may die
``killing``   writers are killed, or have no room, and what is there is read
============= ======================================================================
"""
