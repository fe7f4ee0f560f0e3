"""The sandbox's runs, held against closed forms that know nothing of the engine."""
