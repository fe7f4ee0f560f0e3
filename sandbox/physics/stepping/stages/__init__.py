"""What only some levels call for in a step, one stage a file; `declared.py` lists them."""
