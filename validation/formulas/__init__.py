"""The closed forms: pure functions of SI quantities, written from the textbook, a module a chapter.

They are independent of the formulas in the levels, so that the two hold each other, and they import
nothing of the sandbox. Angles are in radians. "The chapter" is the document that the project
follows; its section stands with each formula, and a line of derivation where it gives none.
Every formula holds for any finite argument unless it says otherwise.
"""
