"""A design and a project of designs as frozen values, expressions as typed trees, pure edits and questions.

Knows neither files nor YAML nor screens.
"""
