"""All of Table II by one model: how far it goes, where energy is lost, what would decide."""
