"""Tracks of falling and bouncing balls, from video: flights, speeds, heights."""
