"""What each panel of the page shows, as small JSON."""
