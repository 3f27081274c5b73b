"""Tools around the renderer that need more than it does."""
