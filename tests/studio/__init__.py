"""Tests of the studio's page in a browser; a package, so that package-scoped fixtures, e.g. the browser, end here."""
