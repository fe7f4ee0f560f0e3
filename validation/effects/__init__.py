"""What effects cost."""
