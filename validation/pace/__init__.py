"""Whether levels run in real time: what a second of each takes to compute."""
