"""Data files, no code: the arm's scene (``tabletop.xml``, ``wood.png``) and the studio's page (``studio/``)."""
