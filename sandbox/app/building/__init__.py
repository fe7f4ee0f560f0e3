"""The editor: a level as a drawing, the tools that change it, and their display on the stage."""
