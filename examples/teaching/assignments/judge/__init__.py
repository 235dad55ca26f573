"""The judge: tasks with right answers and known mistakes, points, and the student's process."""
