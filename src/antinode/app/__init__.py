"""The app: a page that shows a vehicle or a beam, and answers at once when an input moves."""
