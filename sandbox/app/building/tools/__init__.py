"""The tools of the editor, one module for each family; `register` lists them."""
