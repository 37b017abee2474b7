"""Research that is written with stackbounce, and is no part of it."""
