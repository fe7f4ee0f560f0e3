"""The panels around the stage: levels, parameters, read-outs, controls, messages."""
