"""A public benchmark of impacts: problems, reference answers, a scorer, and who gets what right."""
