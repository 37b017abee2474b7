"""Sound of a bouncing ball: the times of its knocks."""
