"""What touches: shapes, coefficients, friction and impacts."""
