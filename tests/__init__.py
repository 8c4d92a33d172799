"""The tests mirror the packages; a folder is a package where fixtures are to end with it, and its parents with it."""
