"""The editor: a level as a drawing, the tools that change it, and what they show on the stage."""
