"""The four lessons: each stands once in each language, for the page and for the documentation.

=========== ================================================================
lesson      reads the lessons, and the links in their texts, to drops of the explorer
en/, de/    the texts, a file for each lesson; the English ones are those of the documentation
=========== ================================================================
"""
