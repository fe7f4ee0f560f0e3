"""The functions that tables of cases name under `own`, in a module named after its table."""
