"""Whether levels run in real time: the computing time per second of each scene."""
