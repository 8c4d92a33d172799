"""Sessions of the studio as events in journals on the disk."""
