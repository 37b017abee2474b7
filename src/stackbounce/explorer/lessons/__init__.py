"""The four lessons: each stands once in each language, for the page and for the documentation.

=========== ================================================================
lesson      reads the lessons
links       the links in their texts, to drops of the explorer
en/, de/    the texts, a file for each lesson; the English ones are those of the documentation
=========== ================================================================
"""

from stackbounce.explorer.lessons.lesson import LANGUAGES, NAMES, Item, Lesson, Step, read_lesson
from stackbounce.explorer.lessons.links import Link, explorer_fragment, split_links

__all__ = [
    "LANGUAGES",
    "NAMES",
    "Item",
    "Lesson",
    "Link",
    "Step",
    "explorer_fragment",
    "read_lesson",
    "split_links",
]
