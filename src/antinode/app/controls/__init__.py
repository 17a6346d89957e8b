"""What the user takes hold of: fields, switches, tables, menus."""
