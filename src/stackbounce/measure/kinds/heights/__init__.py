"""Heights of successive bounces: restitutions."""
