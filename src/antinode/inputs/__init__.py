"""What files, tables and units become: plain numbers, or one sentence about what is wrong."""
