"""A run as one page of HTML: `report` writes it, the other files hold its sections, its style and its view."""
