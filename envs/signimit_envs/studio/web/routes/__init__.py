"""The routes of the studio, a module for each view of the page."""
