"""Files: archives, safe writing, and formats that others use."""
