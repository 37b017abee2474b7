"""Times of successive bounces: restitutions, and how they fall with speed."""
