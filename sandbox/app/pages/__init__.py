"""The pages of the side panel, each in a folder with its computation, its card and its panel."""
