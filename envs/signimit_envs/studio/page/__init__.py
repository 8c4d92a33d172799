"""What the studio's page shows: beliefs, prompts, figures, films and files, as JSON and bytes."""
