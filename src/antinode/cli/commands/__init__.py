"""The commands of `antinode`, one file each; what a command needs is imported when it runs."""
