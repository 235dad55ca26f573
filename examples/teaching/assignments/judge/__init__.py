"""The judge: tasks with their right answers and known mistakes, points, and the student's process."""
