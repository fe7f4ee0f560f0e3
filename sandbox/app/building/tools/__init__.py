"""The tools of the editor, a module a family; `register` is the one list of them."""
