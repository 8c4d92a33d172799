"""The web server of the studio: application, guard, messages and routes."""
