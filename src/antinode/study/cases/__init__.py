"""The cases of a study: from values to loads, beams and frequencies, chunk by chunk."""
