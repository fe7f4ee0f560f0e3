"""What a person measures with on the stage, and the hand that holds it."""
