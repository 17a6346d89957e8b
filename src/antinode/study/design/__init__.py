"""What a study varies, and how."""
